#include "core/threads.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "testing/catch.hpp"

using namespace raysteps;

namespace {

/// Sets the number of threads for one test.
class Threads {
public:
    explicit Threads(int count) { set_default_threads(count); }
    ~Threads() { set_default_threads(before_); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

private:
    int before_ = default_threads();
};

}  // namespace

TEST_CASE("Every number is worked on once, whatever the portions", "[threads]") {
    const Threads four(4);
    const std::size_t count = GENERATE(std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{1000});
    const std::size_t portion = GENERATE(std::size_t{1}, std::size_t{3}, std::size_t{5000});
    std::vector<std::atomic<int>> times(count);
    for_each_on_threads(count, portion, [&](std::size_t i) { ++times[i]; });
    CHECK(std::all_of(times.begin(), times.end(), [](const std::atomic<int>& one) { return one == 1; }));
}

TEST_CASE("Work within work takes no more threads than there are", "[threads]") {
    const Threads three(3);
    std::atomic<int> at_once{0};
    std::atomic<int> most{0};
    std::atomic<int> done{0};
    const auto leaf = [&](std::size_t) {
        const int now = ++at_once;
        int before = most;
        while (before < now && !most.compare_exchange_weak(before, now)) {
        }
        ++done;
        --at_once;
    };
    const auto branch = [&](std::size_t) { for_each_on_threads(8, 1, leaf); };
    for_each_on_threads(8, 1, [&](std::size_t) { for_each_on_threads(8, 1, branch); });
    CHECK(done == 8 * 8 * 8);
    CHECK(most <= 3);
    CHECK(SpareThreads(100).count() == 2);  // all were given back
}

TEST_CASE("What is made in turn lies in the order of its numbers", "[threads]") {
    CHECK(made_in_turn(4, [](std::size_t i) { return 10 * i; }) == std::vector<std::size_t>{0, 10, 20, 30});
    CHECK(made_in_turn(0, [](std::size_t i) { return i; }).empty());
    const std::vector<std::string> words{"a", "bcd", ""};
    CHECK(answers_to(words, [](const std::string& word) { return word.size(); }) == std::vector<std::size_t>{1, 3, 0});
}

TEST_CASE("Of several exceptions the first comes back, and what is left is not begun", "[threads]") {
    std::vector<std::size_t> begun;
    const auto work = [&](std::size_t i) {
        begun.push_back(i);
        if (i >= 2) {
            throw std::runtime_error(std::to_string(i));
        }
    };
    CHECK_THROWS_WITH(for_each_in_turn(100, work), "2");
    CHECK(begun == std::vector<std::size_t>{0, 1, 2});
}

TEST_CASE("An exception in work within work comes back, and the threads with it", "[threads]") {
    const Threads three(3);
    const auto inner = [](std::size_t i) {
        if (i == 5) {
            throw std::runtime_error("five");
        }
    };
    CHECK_THROWS_AS(for_each_on_threads(4, 1, [&](std::size_t) { for_each_on_threads(8, 1, inner); }),
                    std::runtime_error);
    CHECK(SpareThreads(100).count() == 2);
}
