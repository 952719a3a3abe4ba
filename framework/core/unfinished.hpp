#pragma once
// The voice of a stub: says once, on stderr, which function is still to be written and where.
#include <cstdio>

/// step and function as in the step's manifest.
#define RAYSTEPS_TODO(step, function)                                                                            \
    do {                                                                                                         \
        [[maybe_unused]] static const int said_once =                                                            \
            std::fprintf(stderr, "%s:%d: step %s: %s is not written yet\n", __FILE__, __LINE__, step, function); \
    } while (false)
