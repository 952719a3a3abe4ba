#include "remote/fiber.hpp"

#include <cxxabi.h>
#include <sys/mman.h>
#include <ucontext.h>
#include <cerrno>
#include <csetjmp>
#include <cstddef>
#include <cstdlib>
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

/// Each stack begins elsewhere in its topmost page: if all began at the same place, what is on top of them would share
/// a few places of the processor's cache.
constexpr std::size_t k_page_bytes = 4096;
constexpr std::size_t k_shift_bytes = 1088;  // from one to the next: all lines of a page have their turn
static_assert(k_shift_bytes % 16 == 0, "what is on a stack expects it to begin so");

/// Below it lies what nobody may touch: who overflows the stack crashes, as on any other.
class Stack {
public:
    Stack() {
        thread_local std::size_t made = 0;
        size_ = k_stack_bytes + k_page_bytes - made++ * k_shift_bytes % k_page_bytes;
        base_ = mmap(nullptr, k_all_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (base_ == MAP_FAILED || mprotect(base_, k_guard_bytes, PROT_NONE) != 0) {
            throw std::system_error(errno, std::generic_category(), "no stack for a fiber");
        }
    }
    ~Stack() { munmap(base_, k_all_bytes); }
    Stack(const Stack&) = delete;
    Stack& operator=(const Stack&) = delete;

    [[nodiscard]] void* lowest() const { return static_cast<char*>(base_) + k_guard_bytes; }
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    static constexpr std::size_t k_all_bytes = k_guard_bytes + k_stack_bytes + k_page_bytes;
    void* base_ = nullptr;
    std::size_t size_ = 0;
};

// A place to go on from, and the beginning of a fiber as one. change(from, to) goes to `to`, and returns when somebody
// changes to `from`. The sanitizers know swapcontext only, which asks the system to change the mask of signals: that
// takes longer than all the rest.

using Body = void (*)();  // never returns

[[maybe_unused]] void prepare(ucontext_t& context, const Stack& stack, Body body) {
    getcontext(&context);
    context.uc_stack.ss_sp = stack.lowest();
    context.uc_stack.ss_size = stack.size();
    context.uc_link = nullptr;
    makecontext(&context, body, 0);
}

#if RAYSTEPS_SANITIZED
struct Place {
    ucontext_t context;
};
void change(Place& from, Place& to) { swapcontext(&from.context, &to.context); }
void begin_at(Place& place, const Stack& stack, Body body) { prepare(place.context, stack, body); }
#elif defined(__x86_64__) && defined(__LP64__) && !defined(__AVX512F__) && !defined(RAYSTEPS_PORTABLE_FIBERS)
/// What a function must find as it left it, the compiler keeps on the stack: it is told that all else is lost. Of the
/// registers of AVX-512 it is not told: a build for those goes the way below.
struct Place {
    void* stack;
    void* frame;
    void* next;  ///< instruction
};
void change(Place& from, Place& to) {
    Place* left = &from;
    Place* entered = &to;
    asm volatile(
        "leaq 1f(%%rip), %%rax\n\t"
        "movq %%rsp, (%%rdi)\n\t"
        "movq %%rbp, 8(%%rdi)\n\t"
        "movq %%rax, 16(%%rdi)\n\t"
        "movq (%%rsi), %%rsp\n\t"
        "movq 8(%%rsi), %%rbp\n\t"
        "jmpq *16(%%rsi)\n"
        "1:"
        : "+D"(left), "+S"(entered)
        :
        : "rax", "rbx", "rcx", "rdx", "r8", "r9", "r10", "r11", "r12", "r13", "r14", "r15", "xmm0", "xmm1", "xmm2",
          "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15",
          "cc", "memory");
}
void begin_at(Place& place, const Stack& stack, Body body) {
    auto* top = reinterpret_cast<void**>(static_cast<char*>(stack.lowest()) + stack.size());
    top[-1] = nullptr;  // where a caller's address would be: the stack ends here
    place = {.stack = top - 1, .frame = nullptr, .next = reinterpret_cast<void*>(body)};
}
#else
/// The build takes _FORTIFY_SOURCE away from this file (programs.cmake): with it, longjmp takes a jump to another stack
/// for a mistake.
struct Place {
    std::jmp_buf registers;
    ucontext_t first;
    bool begins = false;
};
void change(Place& from, Place& to) {
    if (_setjmp(from.registers) != 0) {
        return;
    }
    if (std::exchange(to.begins, false)) {
        setcontext(&to.first);
        std::abort();  // it did not go there
    }
    _longjmp(to.registers, 1);
}
void begin_at(Place& place, const Stack& stack, Body body) {
    prepare(place.first, stack, body);
    place.begins = true;
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

thread_local Fiber* t_resumed = nullptr;  // last, by this thread

}  // namespace

struct Fiber::State {
    Stack stack;
    Exceptions exceptions;
    Place inside{};
    Place outside{};
};

Fiber::Fiber(std::function<void()> body) : body_(std::move(body)), state_(std::make_unique<State>()) {
    begin_at(state_->inside, state_->stack, &Fiber::enter);
}

Fiber::~Fiber() = default;

void Fiber::enter() {
    Fiber& self = *t_resumed;
    self.body_();
    self.ended_ = true;
    self.stop();
}

void Fiber::resume() {
    State& state = *state_;
    t_resumed = this;
    exchange_with_thread(state.exceptions);
    change(state.outside, state.inside);
    exchange_with_thread(state.exceptions);
}

void Fiber::stop() { change(state_->inside, state_->outside); }

}  // namespace raysteps::remote
