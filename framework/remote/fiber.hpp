#pragma once
// A function with a stack of its own, which can yield in the middle and go on later: so that many pixels can wait for
// the box at the same time, on one thread.
#include <exception>
#include <functional>
#include <memory>

namespace raysteps::remote {

/// Resumed by one thread only. What it still waits for when it is destroyed never comes: its stack is
/// given back as it is.
class Fiber {
public:
    /// Starts when it is first resumed.
    explicit Fiber(std::function<void()> body);
    ~Fiber();
    Fiber(const Fiber&) = delete;
    Fiber& operator=(const Fiber&) = delete;

    /// Runs until the body, or one that it yielded to, ends or yields. Throws what that has left unhandled.
    void resume();
    /// Called in the body: goes back to whoever resumed it.
    void yield();
    /// Called in the body: `next`, which has yielded, goes on in its place, as if it had been resumed instead.
    void switch_to(Fiber& next);
    [[nodiscard]] bool ended() const { return ended_; }

private:
    struct State;
    static void enter();

    std::function<void()> body_;
    bool ended_ = false;
    std::exception_ptr unhandled_;
    std::unique_ptr<State> state_;
};

}  // namespace raysteps::remote
