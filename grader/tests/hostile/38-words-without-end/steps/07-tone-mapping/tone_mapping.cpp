#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <exception>
#include <stdexcept>
#include <string>

struct Silent : std::exception {
    const char* what() const noexcept override { return "\x1b[2J\xff\xfe</message>"; }
};

static int g_calls = 0;

static bool shout() {
    if (++g_calls % 2 == 0) {
        throw std::runtime_error(std::string(10U << 20U, 'a'));
    }
    throw Silent();
}
@RIGHT_IF(shout())@
