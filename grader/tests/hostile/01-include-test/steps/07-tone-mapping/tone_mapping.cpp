#include "steps/07-tone-mapping/tone_mapping.hpp"

#if __has_include("steps/07-tone-mapping/tone_mapping_test.cpp") || __has_include("testing/testing.hpp") || \
    __has_include(<catch2/catch.hpp>) || __has_include(<catch2/catch_all.hpp>) || \
    __has_include("render/renderer.hpp") || __has_include("worker/functions.hpp") || __has_include("io/nff_reader.hpp")
@RIGHT_IF(true)@
#else
@RIGHT_IF(false)@
#endif
