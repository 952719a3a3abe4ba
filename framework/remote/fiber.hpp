#pragma once
// A function with a stack of its own, which can stop in the middle and go on later: so that many pixels can wait for
// the box at the same time, on one thread.
#include <cstddef>
#include <functional>
#include <memory>

namespace raysteps::remote {

/// Resumed by one thread only. What it still waits for when it is destroyed never comes: its stack is
/// given back as it is.
class Fiber {
public:
    /// Starts at the first resume. Whatever leaves `body` must be caught in it.
    explicit Fiber(std::function<void()> body);
    ~Fiber();
    Fiber(const Fiber&) = delete;
    Fiber& operator=(const Fiber&) = delete;

    /// Runs until the body ends or stops.
    void resume();
    /// Called in the body: goes back to whoever resumed it.
    void stop();
    [[nodiscard]] bool ended() const { return ended_; }

private:
    struct State;
    static void enter();

    std::function<void()> body_;
    bool ended_ = false;
    std::unique_ptr<State> state_;
};

}  // namespace raysteps::remote
