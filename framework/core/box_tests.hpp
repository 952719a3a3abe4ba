#pragma once
// Box tests without a call for each of them.
#include <cstdint>

#include "core/box.hpp"

namespace raysteps {

/// For a search that meets boxes by arithmetic of its own, and not by Box::hit: says which ones. They count as those.
class BoxTests {
public:
    explicit BoxTests(const Ray& ray) : ray_(ray), shown_(are_shown()) {}
    ~BoxTests() { count(tests_); }
    BoxTests(const BoxTests&) = delete;
    BoxTests& operator=(const BoxTests&) = delete;

    void add(const Box& box) {
        ++tests_;
        if (shown_) {
            show(box, ray_);
        }
    }

private:
    // Behind the counting wall.
    [[nodiscard]] static bool are_shown();
    static void show(const Box& box, const Ray& ray);
    static void count(std::uint32_t tests);

    const Ray& ray_;
    bool shown_;
    std::uint32_t tests_ = 0;
};

}  // namespace raysteps
