// raysteps-bench: the measurements that need the kit from inside. `./raysteps bench` runs it and shows its numbers.
#include <array>
#include <cstdio>
#include <exception>
#include <string_view>

#include "bench/parse_bench.hpp"
#include "bench/render_bench.hpp"
#include "bench/scale_bench.hpp"
#include "bench/structures.hpp"
#include "io/command_line.hpp"
#include "io/files.hpp"
#include "io/platform.hpp"

namespace {

using namespace raysteps;

constexpr int k_exit_failed = 1;  // the structures do not agree
constexpr int k_exit_usage = 2;   // bad arguments or a bad scene

struct Command {
    std::string_view name;
    std::string (*run)(const std::vector<std::string>& words);
    const char* usage;
};

const std::array k_commands{
    Command{"render", bench::bench_render, bench::k_render_usage},
    Command{"scale", bench::bench_scale, bench::k_scale_usage},
    Command{"parse", bench::bench_parse, bench::k_parse_usage},
    Command{"nff", bench::flat_nff, bench::k_nff_usage},
    Command{"list", bench::list_structures,
            "  raysteps-bench list\n                      the structures that it knows\n"},
};

void print_usage(std::FILE* to) {
    std::fputs("Usage:\n", to);
    for (const Command& command : k_commands) {
        std::fputs(command.usage, to);
    }
}

int run(const std::vector<std::string>& words) {
    if (words.empty()) {
        throw UsageError("expected a command");
    }
    if (words.front() == "--help" || words.front() == "-h") {
        print_usage(stdout);
        return 0;
    }
    for (const Command& command : k_commands) {
        if (command.name == words.front()) {
            std::fputs(command.run({words.begin() + 1, words.end()}).c_str(), stdout);
            return 0;
        }
    }
    throw UsageError("there is no command '" + words.front() + "'");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(utf8_arguments(argc, argv));
    } catch (const ReadError& error) {
        std::fprintf(stderr, "%s\n", error.what());
    } catch (const UsageError& error) {
        std::fprintf(stderr, "raysteps-bench: %s\n", error.what());
        print_usage(stderr);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raysteps-bench: %s\n", error.what());
        return k_exit_failed;
    }
    return k_exit_usage;
}
