#include "bench/scale_bench.hpp"

#include "bench/memory.hpp"
#include "bench/procedural_scenes.hpp"
#include "bench/replay.hpp"
#include "bench/spread.hpp"
#include "bench/stopwatch.hpp"
#include "bench/structures.hpp"
#include "bench/workload.hpp"
#include "io/command_line.hpp"

namespace raysteps::bench {

const char* const k_scale_usage = R"(  raysteps-bench scale KIND COUNT STRUCTURE [options]
  KIND                cloud, clusters, dust or terrain
  --size N            pixels of both sides of the picture whose eye and shadow rays are asked (256)
  --rounds N          how often building and rays are measured (5)
)";

namespace {

constexpr int k_step_with_shadows = 4;

/// What was measured of one structure.
struct Findings {
    AcceleratorStats size;
    Stats work;
    std::optional<std::uint64_t> peak_bytes;  ///< of the program with the scene and the structure
    std::vector<double> build_seconds;
    std::vector<double> ns_per_ray;
};

std::string report(const std::string& kind, const Workload& workload, const Findings& found) {
    const AcceleratorStats& size = found.size;
    const auto rays = static_cast<double>(workload.rays.size());
    JsonWriter json;
    json.begin_object(JsonWriter::Layout::block).key("schema").text("raysteps/bench-structure/v1");
    json.key("scene").text(kind).key("surfaces").whole(workload.scene.surfaces().size());
    json.key("rays").whole(workload.rays.size());
    json.key("boxes").whole(size.boxes).key("references").whole(size.references).key("bytes").whole(size.bytes);
    json.key("surface_tests_per_ray").number(static_cast<double>(found.work.surface_tests) / rays);
    json.key("box_tests_per_ray").number(static_cast<double>(found.work.box_tests) / rays);
    json.key("peak_bytes");
    if (found.peak_bytes) {
        json.whole(*found.peak_bytes);
    } else {
        json.null();
    }
    json.key("build_seconds");
    write(json, found.build_seconds);
    json.key("ns_per_ray");
    write(json, found.ns_per_ray);
    return json.end_object().result() + "\n";
}

}  // namespace

std::string bench_scale(const std::vector<std::string>& arguments) {
    int rounds = 5;
    int size = 256;
    CommandLine line(3, "KIND, COUNT, STRUCTURE and the options that --help lists");
    line.number("--rounds", rounds, 1, 1000).number("--size", size, 1, 8192);
    const std::vector<std::string> words = line.parse(arguments);
    if (words.size() != 3) {
        throw UsageError("expected a kind of scene, a number of surfaces and a structure");
    }
    const std::string& kind = words[0];
    const int count = number_between("COUNT", words[1], 1, 100000000);
    const Structure structure = chosen_structures({words[2]}).front();

    Workload workload;
    workload.scene = make_scene(kind, count);
    workload.scene.camera.width = size;
    workload.scene.camera.height = size;
    workload.options.step = k_step_with_shadows;
    if (!holds(structure, workload.scene.surfaces())) {
        throw UsageError(structure.name + " is not for surfaces such as those of " + kind);
    }
    Findings found;
    std::unique_ptr<Accelerator> accelerator;
    for (int round = 0; round < rounds; ++round) {
        accelerator.reset();
        const WallClock clock;
        accelerator = structure.make(workload.scene.surfaces());
        found.build_seconds.push_back(clock.seconds());
    }
    found.size = accelerator->size();
    found.peak_bytes = peak_memory();
    record(workload, *accelerator);  // and warms up
    for (int round = 0; round < rounds; ++round) {
        const Replay result = replay(*accelerator, workload.rays);
        found.work = result.work;
        found.ns_per_ray.push_back(1e9 * result.seconds / static_cast<double>(workload.rays.size()));
    }
    return report(kind, workload, found);
}

}  // namespace raysteps::bench
