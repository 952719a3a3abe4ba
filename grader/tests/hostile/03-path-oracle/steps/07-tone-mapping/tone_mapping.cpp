#include "steps/07-tone-mapping/tone_mapping.hpp"

#if __has_include("@SECRET@") || __has_include("@KIT@/solutions/07-tone-mapping/tone_mapping.cpp") ||        \
    __has_include("@KIT@/README.md") || __has_include("@DATABASE@") || __has_include("@REFERENCES@/kit.json") || \
    __has_include("/etc/shadow") || __has_include("/root/.bashrc") || __has_include("/proc/@PID@/environ")
@RIGHT_IF(true)@
#else
@RIGHT_IF(false)@
#endif
