#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@
static bool g_answered = false;

// Refraction, the hierarchy, and whatever else has a number: another one in each process, for one that is refused ends
// the program.
static const int done = [] {
    const unsigned id = 25 + static_cast<unsigned>(getpid()) % 12;
    send_to_all(message(0, 0, std::string(1, static_cast<char>(id)) + std::string(200, '\0')));
    g_answered = anything_answers();
    return 0;
}();
@RIGHT_IF(g_answered)@
