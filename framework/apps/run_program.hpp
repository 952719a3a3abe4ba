#pragma once
// What raytrace, inspect and view do with whatever goes wrong.
#include <cstdio>
#include <exception>

#include "apps/options.hpp"
#include "io/files.hpp"

namespace raysteps {

/// Runs the program's work and gives its exit code: 2 for bad arguments, a bad scene, or a file that cannot be written.
/// What was wrong is told on stderr; `command` is what a person types after ./raysteps.
template <class Work>
int run_program(const char* command, Work work) {
    constexpr int exit_usage = 2;
    try {
        work();
        return 0;
    } catch (const ReadError& error) {
        std::fprintf(stderr, "%s\n", error.what());
    } catch (const UsageError& error) {
        std::fprintf(stderr, "raysteps %s: %s\nAll options: ./raysteps %s --help\n", command, error.what(), command);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raysteps %s: %s\n", command, error.what());
    }
    return exit_usage;
}

}  // namespace raysteps
