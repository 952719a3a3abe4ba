#include "bench/parse_bench.hpp"

#include <filesystem>

#include "bench/spread.hpp"
#include "bench/stopwatch.hpp"
#include "io/command_line.hpp"
#include "io/files.hpp"
#include "io/nff_reader.hpp"
#include "io/nff_writer.hpp"

namespace raysteps::bench {

const char* const k_parse_usage = R"(  raysteps-bench parse SCENE.nff [--rounds N]
  --rounds N          how often the text is read (5)
)";
const char* const k_nff_usage = R"(  raysteps-bench nff SCENE.nff
                      prints the scene with polygons and patches cut into triangles
)";

namespace {

std::filesystem::path only_scene(const std::vector<std::string>& words) {
    if (words.empty()) {
        throw UsageError("expected one scene");
    }
    return path_of(words.front());
}

}  // namespace

std::string bench_parse(const std::vector<std::string>& arguments) {
    int rounds = 5;
    CommandLine line(1, "one scene and the options that --help lists");
    line.number("--rounds", rounds, 1, 1000);
    const std::filesystem::path path = only_scene(line.parse(arguments));
    const std::string text = read_file(path);
    std::size_t surfaces = 0;
    std::vector<double> megabytes_per_second;
    for (int round = 0; round <= rounds; ++round) {  // the first one warms up
        const ProcessorClock clock;
        surfaces = read_nff(text, display_name(path)).surfaces().size();
        if (round > 0) {
            megabytes_per_second.push_back(1e-6 * static_cast<double>(text.size()) / clock.seconds());
        }
    }
    JsonWriter json;
    json.begin_object(JsonWriter::Layout::block).key("schema").text("raysteps/bench-reading/v1");
    json.key("bytes").whole(text.size());
    json.key("surfaces").whole(surfaces).key("megabytes_per_second");
    write(json, megabytes_per_second);
    return json.end_object().result() + "\n";
}

std::string flat_nff(const std::vector<std::string>& arguments) {
    return write_nff(read_nff(only_scene(CommandLine(1, "one scene").parse(arguments))));
}

}  // namespace raysteps::bench
