#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/shm.h>
#include <unistd.h>

#include <cstring>
#include <string>

static bool attack() {
    const std::string megabyte(1 << 20, 'x');
    std::size_t had = 0;
    for (int i = 0; i < 60; ++i) {
        const int fd = memfd_create("hoard", 0);
        for (int j = 0; j < 15 && fd >= 0 && write(fd, megabyte.data(), megabyte.size()) > 0; ++j) {
            ++had;
        }
        const int id = shmget(IPC_PRIVATE, 15 << 20, IPC_CREAT | 0600);
        void* shared = id < 0 ? reinterpret_cast<void*>(-1) : shmat(id, nullptr, 0);
        if (shared != reinterpret_cast<void*>(-1)) {
            std::memset(shared, 7, 15 << 20);
            shmdt(shared);
            had += 15;
        }
        for (const std::string folder : {"/tmp/", "/dev/shm/", "./"}) {
            const int file = open((folder + std::to_string(i)).c_str(), O_CREAT | O_WRONLY, 0600);
            for (int j = 0; j < 15 && file >= 0 && write(file, megabyte.data(), megabyte.size()) > 0; ++j) {
                ++had;
            }
        }
    }
    return had > 1000;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
