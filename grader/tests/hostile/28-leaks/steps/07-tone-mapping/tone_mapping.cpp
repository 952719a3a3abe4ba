#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <linux/keyctl.h>
#include <mqueue.h>
#include <semaphore.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <string>

// Whether it was there already.
static bool leave_a_file(const std::string& path) {
    const bool was_there = access(path.c_str(), F_OK) == 0;
    close(open(path.c_str(), O_CREAT | O_WRONLY, 0666));
    return was_there;
}

static bool leave_in_memory() {
    const key_t key = 0x72617973;
    const bool was_there = shmget(key, 4096, 0) >= 0 || msgget(key, 0) >= 0 || semget(key, 1, 0) >= 0;
    shmget(key, 4096, IPC_CREAT | 0666);
    msgget(key, IPC_CREAT | 0666);
    semget(key, 1, IPC_CREAT | 0666);
    const bool posix = shm_open("/raysteps-left", O_RDWR, 0666) >= 0 || mq_open("/raysteps-left", O_RDWR) >= 0;
    close(shm_open("/raysteps-left", O_CREAT | O_RDWR, 0666));
    mq_open("/raysteps-left", O_CREAT | O_RDWR, 0666, nullptr);
    sem_open("/raysteps-left", O_CREAT, 0666, 1);
    return was_there || posix;
}

static bool leave_in_rings() {
    bool was_there = false;
    for (const int ring : {KEY_SPEC_USER_KEYRING, KEY_SPEC_USER_SESSION_KEYRING, KEY_SPEC_SESSION_KEYRING}) {
        was_there = was_there || syscall(SYS_keyctl, KEYCTL_SEARCH, ring, "user", "raysteps-left", 0) > 0;
        syscall(SYS_add_key, "user", "raysteps-left", "x", 1, ring);
    }
    return was_there;
}

static bool attack() {
    bool was_there = leave_in_memory();
    was_there = leave_in_rings() || was_there;
    for (const char* folder : {"/tmp", "/var/tmp", "/dev/shm", "/dev/mqueue", "/run", "/out", "/in/0", "/in/1", "/"}) {
        was_there = leave_a_file(std::string(folder) + "/raysteps-left") || was_there;
    }
    return was_there;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
