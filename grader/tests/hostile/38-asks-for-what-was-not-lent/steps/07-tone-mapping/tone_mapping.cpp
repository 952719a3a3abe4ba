#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@
static bool g_answered = false;

static bool guess() {
    for (unsigned id = 30; id < 64; ++id) {
        for (unsigned number = 0; number < 4; ++number) {
            std::string words(1, static_cast<char>(id));
            words += bytes_of(number) + bytes_of(number) + std::string(64, '\0');
            send_to_all(message(1, 0, words));
            g_answered = g_answered || anything_answers();
        }
    }
    return g_answered;
}
@RIGHT_IF(guess())@
