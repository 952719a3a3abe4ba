#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <sys/ptrace.h>
#include <sys/uio.h>
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
    bool traced = false;
    for (int pid = 1; pid < 2000; ++pid) {
        if (pid != getpid() && (ptrace(PTRACE_SEIZE, pid, nullptr, nullptr) == 0)) {
            traced = true;
        }
        char byte = 0;
        iovec mine{&byte, 1};
        iovec other{reinterpret_cast<void*>(0x400000), 1};
        traced = traced || (pid != getpid() && process_vm_writev(pid, &mine, 1, &other, 1, 0) > 0);
    }
    return traced;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
