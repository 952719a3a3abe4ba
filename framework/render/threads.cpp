#include "render/threads.hpp"

#include <system_error>
#include <thread>
#include <vector>

namespace raysteps {

void run_on_threads(int count, const std::function<void()>& work) {
    std::vector<std::thread> others;
    try {
        for (int i = 1; i < count; ++i) {
            others.emplace_back(work);
        }
    } catch (const std::system_error&) {
        // fewer threads than asked for: slower, and the same picture
    }
    work();
    for (std::thread& other : others) {
        other.join();
    }
}

}  // namespace raysteps
