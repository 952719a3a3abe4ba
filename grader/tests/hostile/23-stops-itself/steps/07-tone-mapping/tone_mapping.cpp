#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <unistd.h>

static bool attack() {
    kill(0, SIGSTOP);
    raise(SIGSTOP);
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
