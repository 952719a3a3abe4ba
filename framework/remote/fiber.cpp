#include "remote/fiber.hpp"

#include <cxxabi.h>
#include <sys/mman.h>
#include <ucontext.h>
#include <cerrno>
#include <csetjmp>
#include <cstdint>
#include <system_error>
#include <utility>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RAYSTEPS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RAYSTEPS_SANITIZED 1
#endif
#endif
#ifndef RAYSTEPS_SANITIZED
#define RAYSTEPS_SANITIZED 0
#endif

namespace raysteps::remote {

namespace {

constexpr std::size_t k_stack_bytes = std::size_t{8} << 20U;  // as a thread's; what is not touched costs nothing
constexpr std::size_t k_guard_bytes = std::size_t{1} << 20U;

/// Below it lies what nobody may touch: who overflows the stack crashes, as on any other.
class Stack {
public:
    Stack() {
        base_ = mmap(nullptr, k_guard_bytes + k_stack_bytes, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (base_ == MAP_FAILED || mprotect(base_, k_guard_bytes, PROT_NONE) != 0) {
            throw std::system_error(errno, std::generic_category(), "no stack for a fiber");
        }
    }
    ~Stack() { munmap(base_, k_guard_bytes + k_stack_bytes); }
    Stack(const Stack&) = delete;
    Stack& operator=(const Stack&) = delete;

    [[nodiscard]] void* lowest() const { return static_cast<char*>(base_) + k_guard_bytes; }

private:
    void* base_;
};

/// A place to go on from. Saving one by _setjmp costs no system call, as swapcontext does; but the sanitizers know
/// the latter only. The build takes _FORTIFY_SOURCE away from this file (programs.cmake): with it, longjmp takes a jump
/// to another stack for a mistake.
#if RAYSTEPS_SANITIZED
struct Place {
    ucontext_t context;
};
void change(Place& from, Place& to) { swapcontext(&from.context, &to.context); }
#else
struct Place {
    std::jmp_buf registers;
};
void change(Place& from, Place& to) {
    if (_setjmp(from.registers) == 0) {
        _longjmp(to.registers, 1);
    }
}
#endif

/// What the C++ runtime notes of a thread's exceptions, as the ABI of GCC and Clang lays it out. A fiber that stops in
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

}  // namespace

struct Fiber::State {
    Stack stack;
    Exceptions exceptions;
    ucontext_t first{};  ///< where the body begins
    Place inside{};
    Place outside{};
    bool started = false;
};

Fiber::Fiber(std::function<void()> body) : body_(std::move(body)), state_(std::make_unique<State>()) {}

Fiber::~Fiber() = default;

// makecontext hands on whole numbers only.
void Fiber::enter(unsigned high, unsigned low) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): it was one
    reinterpret_cast<Fiber*>((static_cast<std::uintptr_t>(high) << 32U) | low)->run();
}

void Fiber::run() {
    body_();
    ended_ = true;
    stop();
}

void Fiber::resume() {
    State& state = *state_;
    exchange_with_thread(state.exceptions);
    if (state.started) {
        change(state.outside, state.inside);
    } else {
        begin();
    }
    exchange_with_thread(state.exceptions);
}

void Fiber::begin() {
    State& state = *state_;
    state.started = true;
    getcontext(&state.first);
    state.first.uc_stack.ss_sp = state.stack.lowest();
    state.first.uc_stack.ss_size = k_stack_bytes;
    state.first.uc_link = nullptr;
    const auto self = reinterpret_cast<std::uintptr_t>(this);
    makecontext(&state.first, reinterpret_cast<void (*)()>(&Fiber::enter), 2, static_cast<unsigned>(self >> 32U),
                static_cast<unsigned>(self & 0xFFFFFFFFU));
#if RAYSTEPS_SANITIZED
    swapcontext(&state.outside.context, &state.first);
#else
    if (_setjmp(state.outside.registers) == 0) {
        setcontext(&state.first);
    }
#endif
}

void Fiber::stop() { change(state_->inside, state_->outside); }

}  // namespace raysteps::remote
