// The entry point of every test program, for both generations of Catch2.
// It replaces Catch2WithMain: link with Catch2::Catch2. When both are linked, this main is the one that counts.
#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_RUNNER
#endif
#include "testing/catch.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

bool g_is_testing = false;

/// Where a step calls exit() in a test, what Catch2 is in the middle of would be taken apart, and the program crash.
void end_at_once() {
    if (g_is_testing) {
        std::fputs("\nexit() was called\n", stderr);
        std::fflush(nullptr);
        std::_Exit(1);
    }
}

}  // namespace

int main(int argc, char* argv[]) {
    Catch::Session session;
#if RAYSTEPS_CATCH_VERSION == 2
    // As Catch2 3 does by itself: a filter that matches no test is a failure, not a success.
    session.configData().warnings = static_cast<Catch::WarnAbout::What>(Catch::WarnAbout::NoTests);
#endif
    g_is_testing = std::atexit(end_at_once) == 0;
    const int failed = session.run(argc, argv);
    g_is_testing = false;
    return failed == 0 ? 0 : 1;  // not how many failed: a number may mean something else
}
