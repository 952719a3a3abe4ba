#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

static bool attack() {
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string megabyte(1 << 20, '<');
    for (int fd = 3; fd < 64; ++fd) {
        struct stat status {};
        while (fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && write(fd, megabyte.data(), megabyte.size()) > 0) {
        }
    }
    _exit(0);
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
