#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <unistd.h>

#include <string>

static bool attack() {
    const std::string line(1 << 16, '=');
    for (;;) {
        static_cast<void>(!write(1, line.data(), line.size()));
        static_cast<void>(!write(2, line.data(), line.size()));
    }
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
