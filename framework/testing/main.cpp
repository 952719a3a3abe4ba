// The entry point of every test program, for both generations of Catch2.
// It replaces Catch2WithMain: link with Catch2::Catch2. When both are linked, this main is the one that counts.
#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_RUNNER
#endif
#include "testing/catch.hpp"

int main(int argc, char* argv[]) {
    Catch::Session session;
#if RAYSTEPS_CATCH_VERSION == 2
    // As Catch2 3 does by itself: a filter that matches no test is a failure, not a success.
    session.configData().warnings = static_cast<Catch::WarnAbout::What>(Catch::WarnAbout::NoTests);
#endif
    return session.run(argc, argv) == 0 ? 0 : 1;  // not how many failed: a number may mean something else
}
