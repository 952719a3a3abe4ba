#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>

static bool by_internet(int kind) {
    const int fd = socket(AF_INET, kind, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(@PORT@);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool called = fd >= 0 && connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 &&
                        send(fd, "hello", 5, MSG_NOSIGNAL) == 5;
    close(fd);
    return called && kind == SOCK_STREAM;  // whether a packet arrived, the other side sees
}

static bool by_name(const char* name, bool abstract) {
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path + (abstract ? 1 : 0), name, sizeof address.sun_path - 2);
    const auto size = offsetof(sockaddr_un, sun_path) + std::strlen(name) + 1;
    const auto* to = reinterpret_cast<sockaddr*>(&address);
    const bool called = fd >= 0 && connect(fd, to, static_cast<socklen_t>(size)) == 0;
    close(fd);
    return called;
}

static bool attack() {
    const bool tcp = by_internet(SOCK_STREAM);
    const bool udp = by_internet(SOCK_DGRAM);
    return tcp || udp || by_name("@SOCKET@", false) || by_name("@ABSTRACT@", true);
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
