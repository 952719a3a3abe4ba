#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <chrono>
#include <system_error>
#include <thread>
#include <vector>

static bool attack() {
    unsigned born = 0;
    try {
        for (; born < 3000; ++born) {
            std::thread([] { std::this_thread::sleep_for(std::chrono::seconds(20)); }).detach();
        }
    } catch (const std::system_error&) {
    }
    return born > 200;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
