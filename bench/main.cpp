// raysteps-bench: the measurements that need the kit from inside. `./raysteps bench` runs it and shows its numbers.
#include <cstdio>
#include <exception>

#include "bench/arguments.hpp"
#include "bench/render_bench.hpp"
#include "io/read_error.hpp"

namespace {

using namespace raysteps;
using namespace raysteps::bench;

constexpr int k_exit_failed = 1;  // the structures do not agree
constexpr int k_exit_usage = 2;   // bad arguments or a bad scene

void print_usage(std::FILE* to) { std::fprintf(to, "Usage, each prints JSON:\n%s", k_render_usage); }

int run(const std::vector<std::string>& words) {
    if (words.empty() || words.front() == "--help" || words.front() == "-h") {
        print_usage(words.empty() ? stderr : stdout);
        return words.empty() ? k_exit_usage : 0;
    }
    if (words.front() != "render") {
        throw bench::UsageError("expected render, found '" + words.front() + "'");
    }
    std::fputs(bench_render({words.begin() + 1, words.end()}).c_str(), stdout);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const ReadError& error) {
        std::fprintf(stderr, "%s\n", error.what());
    } catch (const bench::UsageError& error) {
        std::fprintf(stderr, "raysteps-bench: %s\n", error.what());
        print_usage(stderr);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raysteps-bench: %s\n", error.what());
        return k_exit_failed;
    }
    return k_exit_usage;
}
