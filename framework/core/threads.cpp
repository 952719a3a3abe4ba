#include "core/threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace raysteps {
namespace {

std::atomic<int>& chosen_threads() {
    static std::atomic<int> count{std::max(1, static_cast<int>(std::thread::hardware_concurrency()))};
    return count;
}

std::atomic<int>& taken_threads() {
    static std::atomic<int> count{0};
    return count;
}

std::atomic<WorkRunner>& chosen_runner() {
    static std::atomic<WorkRunner> runner{nullptr};
    return runner;
}

}  // namespace

void set_work_runner(WorkRunner runner) { chosen_runner() = runner; }

bool work_waits() { return chosen_runner() != nullptr; }

int default_threads() { return chosen_threads(); }

void set_default_threads(int count) { chosen_threads() = std::max(1, count); }

void run_on_threads(int count, const std::function<void()>& work) {
    if (const WorkRunner runner = chosen_runner()) {
        runner(count, work);
        return;
    }
    std::exception_ptr failed;
    std::mutex guard;
    const auto guarded = [&] {
        try {
            work();
        } catch (...) {
            const std::scoped_lock lock(guard);
            failed = failed ? failed : std::current_exception();
        }
    };
    std::vector<std::thread> others;
    try {
        others.reserve(static_cast<std::size_t>(std::max(0, count - 1)));
        for (int i = 1; i < count; ++i) {
            others.emplace_back(guarded);
        }
    } catch (const std::exception&) {
        // no more threads, or no memory for one: slower, and the same result
    }
    guarded();
    for (std::thread& other : others) {
        other.join();
    }
    if (failed) {
        std::rethrow_exception(failed);
    }
}

void run_in_portions(int threads, std::size_t count, std::size_t portion, PortionWork work, const void* what) {
    const std::size_t portions = (count + portion - 1) / portion;
    const auto most = static_cast<std::size_t>(std::max(1, threads));
    std::atomic<std::size_t> next{0};
    run_on_threads(static_cast<int>(std::min(portions, most)), [&] {
        try {
            for (std::size_t begin = next.fetch_add(portion); begin < count; begin = next.fetch_add(portion)) {
                work(what, begin, std::min(begin + portion, count));
            }
        } catch (...) {
            next = count;  // nobody asks for the rest
            throw;
        }
    });
}

SpareThreads::SpareThreads(std::size_t most) {
    int taken = taken_threads();
    int count = 0;
    do {
        const int left = std::max(0, default_threads() - 1 - taken);
        count = static_cast<int>(std::min(static_cast<std::size_t>(left), most));
    } while (!taken_threads().compare_exchange_weak(taken, taken + count));
    count_ = count;
}

SpareThreads::~SpareThreads() { taken_threads() -= count_; }

}  // namespace raysteps
