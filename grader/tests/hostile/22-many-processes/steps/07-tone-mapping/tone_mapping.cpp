#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

static bool attack() {
    std::vector<pid_t> children;
    while (children.size() < 300) {
        const pid_t child = fork();
        if (child < 0) {
            break;
        }
        if (child == 0) {
            alarm(20);
            pause();
            _exit(0);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
    }
    return children.size() > 100;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
