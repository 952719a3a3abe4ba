#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <fcntl.h>
#include <unistd.h>

#include <string>

static bool attack() {
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string megabyte(1 << 20, 'x');
    bool had = false;
    for (const char* path : {"/tmp/huge", "huge", "/dev/shm/huge", "@TRACE@"}) {
        const int fd = open(path, O_CREAT | O_RDWR, 0600);
        had = had || (fd >= 0 && ftruncate(fd, 1L << 40) == 0);
        int written = 0;
        while (fd >= 0 && written < 1000 && write(fd, megabyte.data(), megabyte.size()) > 0) {
            ++written;
        }
        had = had || written > 200;
    }
    return had;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
