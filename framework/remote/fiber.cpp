#include "remote/fiber.hpp"

#include <cxxabi.h>
#include <utility>
#include "remote/asm_context.hpp"
#include "remote/stack.hpp"
#include "remote/system_context.hpp"

namespace raysteps::remote {

namespace {

#if RAYSTEPS_ASM_CONTEXT && !RAYSTEPS_SANITIZED && !defined(RAYSTEPS_PORTABLE_FIBERS)
using Place = AsmContext;
#else
using Place = SystemContext;
#endif

/// What the C++ runtime notes of a thread's exceptions, as the ABI of GCC and Clang lays it out. A fiber that yields in
/// a handler takes it along.
struct Exceptions {
    void* caught = nullptr;
    unsigned uncaught = 0;
};

void exchange_with_thread(Exceptions& kept) {
    auto& current = *reinterpret_cast<Exceptions*>(abi::__cxa_get_globals());
    std::swap(current.caught, kept.caught);
    std::swap(current.uncaught, kept.uncaught);
}

thread_local Fiber* t_resumed = nullptr;  // last, on this thread

}  // namespace

struct Fiber::State {
    Stack stack;
    Exceptions exceptions;  ///< of whoever resumed it, while it runs
    Place inside{};
    Place* outside = nullptr;  ///< where it was resumed
};

Fiber::Fiber(std::function<void()> body) : body_(std::move(body)), state_(std::make_unique<State>()) {
    make_context_at(state_->inside, state_->stack, &Fiber::enter);
}

Fiber::~Fiber() = default;

void Fiber::enter() {
    Fiber& self = *t_resumed;
    try {
        self.body_();
    } catch (...) {
        self.unhandled_ = std::current_exception();
    }
    self.ended_ = true;
    self.yield();
}

void Fiber::resume() {
    Place outside{};
    state_->outside = &outside;
    t_resumed = this;
    exchange_with_thread(state_->exceptions);
    switch_context(outside, state_->inside);
    if (t_resumed->unhandled_) {
        std::rethrow_exception(std::exchange(t_resumed->unhandled_, nullptr));
    }
}

void Fiber::yield() {
    exchange_with_thread(state_->exceptions);
    switch_context(state_->inside, *state_->outside);
}

void Fiber::switch_to(Fiber& next) {
    next.state_->outside = state_->outside;
    t_resumed = &next;
    exchange_with_thread(state_->exceptions);
    exchange_with_thread(next.state_->exceptions);
    switch_context(state_->inside, next.state_->inside);
}

}  // namespace raysteps::remote
