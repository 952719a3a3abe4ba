#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cstdio>
#include <initializer_list>

static bool attack() {
    bool more = unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0;
    more = mount("none", "/tmp", "tmpfs", 0, nullptr) == 0 || more;
    more = mount("/", "/in", nullptr, MS_BIND | MS_REC, nullptr) == 0 || more;
    for (const char* kind : {"user", "mnt", "pid", "net"}) {
        char path[64];
        std::snprintf(path, sizeof path, "/proc/1/ns/%s", kind);
        const int fd = open(path, O_RDONLY);
        more = (fd >= 0 && setns(fd, 0) == 0) || more;
    }
    more = chroot("/tmp") == 0 || more;
    more = setuid(0) == 0 || more;
    return mknod("/tmp/disk", S_IFBLK | 0600, makedev(8, 0)) == 0 || more;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
