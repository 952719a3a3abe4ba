#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

@AFTER_OPTION@


#include <sys/stat.h>

static bool attack() {
    for (const std::string option : {"-o", "--stats"}) {
        const std::string path = after(option);
        unlink(path.c_str());
        rename(path.c_str(), "/tmp/away");
        if (symlink("@SECRET@", path.c_str()) == 0 || link("/etc/passwd", path.c_str()) == 0) {
            continue;
        }
        mkfifo(path.c_str(), 0666);
        mkdir(path.c_str(), 0777);
    }
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
