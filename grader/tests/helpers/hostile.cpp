// A program that misbehaves in the way its first argument says, and tells how far it came.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/epoll.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

extern char** environ;

namespace {

using Words = std::vector<std::string>;

void touch(long megabytes) {
    const std::size_t size = static_cast<std::size_t>(megabytes) << 20U;
    auto* memory = static_cast<volatile char*>(std::malloc(size));
    if (memory == nullptr) {
        std::cout << "refused\n";
        std::exit(1);
    }
    for (std::size_t at = 0; at < size; at += 4096) {
        memory[at] = 1;
    }
}

int answer_errno() {
    std::cout << std::strerror(errno) << '\n';
    return 1;
}

int read_file(const Words& words) {
    std::ifstream file(words.at(0));
    std::stringstream text;
    text << file.rdbuf();
    std::cout << (file ? text.str() : "refused\n");
    return file ? 0 : 1;
}

int connect_to(const Words& words) {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    if (fd < 0) {
        return answer_errno();
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(words.at(0))));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
        return answer_errno();
    }
    std::cout << "connected\n";
    return 0;
}

// A pair of sockets that belong to each other can still write to somebody else.
int send_to(const Words& words) {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_DGRAM, 0, pair) != 0) {
        return answer_errno();
    }
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    words.at(0).copy(address.sun_path, sizeof address.sun_path - 1);
    if (sendto(pair[0], "hello", 5, 0, reinterpret_cast<sockaddr*>(&address), sizeof address) != 5) {
        return answer_errno();
    }
    std::cout << "written\n";
    return 0;
}

int bear(const Words& words) {
    int born = 0;
    for (; born < std::stoi(words.at(0)); ++born) {
        const pid_t child = fork();
        if (child < 0) {
            break;
        }
        if (child == 0) {
            sleep(2);
            _exit(0);
        }
    }
    std::cout << born << '\n';
    return 0;
}

int bomb(const Words&) {
    setsid();
    for (;;) {
        if (fork() < 0) {
            usleep(1000);
        }
    }
}

int start_threads(const Words& words) {
    std::vector<std::thread> threads;
    try {
        for (int n = 0; n < std::stoi(words.at(0)); ++n) {
            threads.emplace_back([] { std::this_thread::sleep_for(std::chrono::milliseconds(500)); });
        }
    } catch (const std::system_error&) {
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    std::cout << threads.size() << '\n';
    return 0;
}

int eat(const Words& words) {
    const int eaters = words.size() > 1 ? std::stoi(words.at(1)) : 0;
    for (int n = 0; n < eaters; ++n) {
        if (fork() == 0) {
            touch(std::stol(words.at(0)));
            sleep(30);
            _exit(0);
        }
    }
    if (eaters == 0) {
        touch(std::stol(words.at(0)));
    }
    while (wait(nullptr) > 0) {
    }
    std::cout << "full\n";
    return 0;
}

/// So many processes, for so many seconds of processor time each; without an end where none are given.
int spin(const Words& words) {
    const double seconds = words.size() > 1 ? std::stod(words.at(1)) : HUGE_VAL;
    for (int n = 1; n < std::stoi(words.at(0)); ++n) {
        if (fork() == 0) {
            break;
        }
    }
    while (static_cast<double>(std::clock()) < seconds * CLOCKS_PER_SEC) {
    }
    return 0;
}

int stubborn(const Words&) {
    for (const int number : {SIGTERM, SIGINT, SIGHUP, SIGXCPU}) {
        std::signal(number, SIG_IGN);
    }
    for (;;) {
        sleep(60);
    }
}

int leave_a_daemon(const Words&) {
    if (fork() == 0) {
        setsid();
        if (fork() == 0) {
            sleep(60);
        }
        _exit(0);
    }
    wait(nullptr);
    std::cout << "done\n";
    return 0;
}

int flood(const Words&) {
    const std::string line(1 << 16, 'x');
    for (int n = 0; n < 800; ++n) {
        std::cout << line;
    }
    return 0;
}

int fill(const Words& words) {
    const std::string megabyte(1 << 20, 'x');
    int files = 0;
    for (; files < 500; ++files) {
        std::ofstream file(words.at(0) + "/flood" + std::to_string(files));
        if (!file.write(megabyte.data(), static_cast<std::streamsize>(megabyte.size())).flush()) {
            break;
        }
    }
    std::cout << files << '\n';
    return 0;
}

int write_to(const Words& words) {
    std::signal(SIGXFSZ, SIG_IGN);
    std::ofstream file(words.at(0), std::ios::binary | std::ios::trunc);
    const std::string megabyte(1 << 20, 'x');
    for (int n = 0; n < std::stoi(words.at(1)); ++n) {
        file.write(megabyte.data(), static_cast<std::streamsize>(megabyte.size()));
    }
    return file.flush() ? 0 : 1;
}

int hoard(const Words& words) {
    for (int n = 0; n < std::stoi(words.at(0)); ++n) {
        const int fd = memfd_create("hoard", 0);
        const std::string megabyte(1 << 20, 'x');
        if (fd < 0 || write(fd, megabyte.data(), megabyte.size()) < 0) {
            return answer_errno();
        }
    }
    std::cout << "full\n";
    return 0;
}

int list_open_files(const Words&) {
    for (int fd = 0; fd < 256; ++fd) {
        if (fcntl(fd, F_GETFD) >= 0) {
            std::cout << fd << ' ';
        }
    }
    return 0;
}

int environment(const Words&) {
    for (char** word = environ; *word != nullptr; ++word) {
        std::cout << *word << '\n';
    }
    return 0;
}

/// Which of these files or folders can be opened.
int open_each(const Words& words) {
    for (const std::string& word : words) {
        if (open(word.c_str(), O_RDONLY | O_NONBLOCK) >= 0) {
            std::cout << word << '\n';
        }
    }
    return 0;
}

/// Of a file of its own: with one of a file that others open, these would wait.
long ask_for_a_lease() { return fcntl(open("/tmp/own", O_RDONLY | O_CREAT, 0600), F_SETLEASE, F_RDLCK); }

/// Of a file that all tasks see: what comes of it another task can ask for.
long lock_for_all() { return flock(open("/usr/lib", O_RDONLY), LOCK_SH | LOCK_NB); }
long lock_a_part() {
    struct flock part {};
    part.l_type = F_RDLCK;
    return fcntl(open("/usr/lib", O_RDONLY), F_SETLK, &part);
}
long watch_for_all() { return inotify_add_watch(inotify_init(), "/usr/lib", IN_OPEN); }
long set_times() { return utimensat(AT_FDCWD, "/dev/null", nullptr, 0); }

/// Of a folder that is on the disk: this waits for all that others have written there.
long wait_for_the_disk() { return fsync(open("/usr/lib", O_RDONLY)); }
long wait_for_data() { return fdatasync(open("/usr/lib", O_RDONLY)); }
long wait_for_a_part() { return sync_file_range(open("/proc/self/exe", O_RDONLY), 0, 0, SYNC_FILE_RANGE_WRITE); }
long wait_for_a_map() {
    void* const page = mmap(nullptr, 1, PROT_READ, MAP_SHARED, open("/proc/self/exe", O_RDONLY), 0);
    return msync(page, 1, MS_SYNC);
}
long open_to_wait() { return open("/proc/self/exe", O_RDONLY | O_DSYNC); }
long open_to_wait_by_number() { return syscall(SYS_openat, AT_FDCWD, "/proc/self/exe", O_RDONLY | O_SYNC, 0); }
long open_past_the_cache() { return open("/proc/self/exe", O_RDONLY | O_DIRECT); }
long go_past_the_cache() { return fcntl(open("/proc/self/exe", O_RDONLY), F_SETFL, O_DIRECT); }
long write_and_wait() {
    char byte = 0;
    const iovec one{&byte, 1};
    return syscall(SYS_pwritev2, STDERR_FILENO, &one, 0, -1L, -1L, 0);
}
long ask_for_queued_work() {
    unsigned long queue = 0;
    return syscall(SYS_io_setup, 1, &queue);
}

/// Which of the system's services answer that a ray tracer has no use for.
int ask_system(const Words&) {
    const std::map<std::string, std::function<long()>> services{
        {"disk", wait_for_the_disk},
        {"disk for a map", wait_for_a_map},
        {"disk for a part", wait_for_a_part},
        {"disk for data", wait_for_data},
        {"disk for each write", open_to_wait},
        {"disk for each write by number", open_to_wait_by_number},
        {"disk for one write", write_and_wait},
        {"disk past the cache", open_past_the_cache},
        {"disk past the cache from now on", go_past_the_cache},
        {"events", [] { return static_cast<long>(epoll_create1(0)); }},
        {"keys", [] { return syscall(SYS_keyctl, 0, -3, 1); }},
        {"lease", ask_for_a_lease},
        {"lock", lock_for_all},
        {"lock of a part", lock_a_part},
        {"memory", [] { return static_cast<long>(memfd_create("asked", 0)); }},
        {"namespaces", [] { return static_cast<long>(unshare(CLONE_NEWNET)); }},
        {"pair", [] { int pair[2]; return static_cast<long>(socketpair(AF_UNIX, SOCK_DGRAM, 0, pair)); }},
        {"queued work", ask_for_queued_work},
        {"socket", [] { return static_cast<long>(socket(AF_INET, SOCK_STREAM, 0)); }},
        {"times", set_times},
        {"trace", [] { return ptrace(PTRACE_TRACEME, 0, nullptr, nullptr); }},
        {"watch", watch_for_all},
    };
    for (const auto& [name, ask] : services) {
        if (ask() >= 0) {
            std::cout << name << '\n';
        }
    }
    return 0;
}

int tell_limit_on_memory(const Words&) {
    rlimit limit{};
    getrlimit(RLIMIT_AS, &limit);
    std::cout << limit.rlim_cur << ' ' << limit.rlim_max << '\n';
    return 0;
}

/// Not by a call, which the first process of a namespace does not hear.
int crash(const Words&) {
    *static_cast<volatile int*>(nullptr) = 1;
    return 0;
}

/// Whether it may choose whom the kernel ends for want of memory.
int spare_itself(const Words&) { return open("/proc/self/oom_score_adj", O_WRONLY) >= 0 ? 0 : answer_errno(); }

const std::map<std::string, std::function<int(const Words&)>> ways{
    {"abort", [](const Words&) -> int { std::abort(); }},
    {"ask", ask_system},
    {"bear", bear},
    {"bomb", bomb},
    {"code", [](const Words& words) { return std::stoi(words.at(0)); }},
    {"connect", connect_to},
    {"crash", crash},
    {"send", send_to},
    {"spare", spare_itself},
    {"daemon", leave_a_daemon},
    {"eat", eat},
    {"environment", environment},
    {"fifo", [](const Words& words) { return mkfifo(words.at(0).c_str(), 0600); }},
    {"files", list_open_files},
    {"fill", fill},
    {"flood", flood},
    {"hoard", hoard},
    {"kill", [](const Words& words) { return kill(std::stoi(words.at(0)), SIGKILL) == 0 ? 0 : answer_errno(); }},
    {"limit", tell_limit_on_memory},
    {"link", [](const Words& words) { return symlink(words.at(0).c_str(), words.at(1).c_str()); }},
    {"open", open_each},
    {"read", read_file},
    {"signal", [](const Words& words) { return std::raise(std::stoi(words.at(0))); }},
    {"spin", spin},
    {"stubborn", stubborn},
    {"threads", start_threads},
    {"user", [](const Words&) { std::cout << getuid() << '\n'; return 0; }},
    {"write", write_to},
    {"echo",
     [](const Words&) {
         std::cout << std::cin.rdbuf();
         return 0;
     }},
};

}  // namespace

int main(int count, char** words) {
    return count > 1 ? ways.at(words[1])(Words(words + 2, words + count)) : 0;
}
