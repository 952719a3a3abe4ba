#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@
// Another function in each process: the first that is refused ends the program.
static bool guess() {
    const unsigned id = 33 + static_cast<unsigned>(getpid()) % 8;
    const std::string words = bytes_of(1U) + bytes_of(1U) + std::string(64, '\0');
    send_to_all(message(0, 0, std::string(1, static_cast<char>(id)) + words));
    return anything_answers();
}
@RIGHT_IF(guess())@
