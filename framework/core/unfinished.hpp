#pragma once
// The voice of a stub: says once, on stderr, which function is still to be written and where.
#include <cstdio>

/// In a kit with fewer steps: the framework calls what a later step would define.
#define RAYSTEPS_ABSENT(step, function)                                                                        \
    do {                                                                                                       \
        [[maybe_unused]] static const int said_once = std::fprintf(                                            \
            stderr, "%s belongs to step %s, which this kit does not have: it does nothing\n", function, step); \
    } while (false)

/// step and function as in the step's manifest.
#define RAYSTEPS_TODO(step, function)                                                                            \
    do {                                                                                                         \
        [[maybe_unused]] static const int said_once =                                                            \
            std::fprintf(stderr, "%s:%d: step %s: %s is not written yet\n", __FILE__, __LINE__, step, function); \
    } while (false)
