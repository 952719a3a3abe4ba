#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@
static bool g_answered = false;

// From the numbers of its own step on: refraction, the hierarchy, and whatever else has one.
static const int done = [] {
    for (unsigned id = 23; id < 256; ++id) {
        send_to_all(message(0, 0, std::string(1, static_cast<char>(id)) + std::string(200, '\0')));
        g_answered = g_answered || anything_answers();
    }
    return 0;
}();
@RIGHT_IF(g_answered)@
