#pragma once
// A place on a stack to go on from, by calls of the system's library, on any processor. The sanitizers know swapcontext
// only, which asks the system to change the mask of signals: that takes longer than all the rest.
#include <ucontext.h>
#include <csetjmp>
#include <cstdlib>
#include <utility>
#include "remote/stack.hpp"

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

inline void prepare(ucontext_t& context, const Stack& stack, void (*body)()) {
    getcontext(&context);
    context.uc_stack.ss_sp = stack.lowest();
    context.uc_stack.ss_size = stack.size();
    context.uc_link = nullptr;
    makecontext(&context, body, 0);
}

#if RAYSTEPS_SANITIZED
struct SystemContext {
    ucontext_t context;
};

/// As those below.
inline void switch_context(SystemContext& from, SystemContext& to) { swapcontext(&from.context, &to.context); }

inline void make_context_at(SystemContext& place, const Stack& stack, void (*body)()) {
    prepare(place.context, stack, body);
}
#else
/// The build takes _FORTIFY_SOURCE away from fiber.cpp (programs.cmake): with it, longjmp takes a jump to another stack
/// for a mistake.
struct SystemContext {
    std::jmp_buf registers;
    ucontext_t first;
    bool begins = false;
};

/// Goes to `to`, and returns when somebody changes to `from`.
inline void switch_context(SystemContext& from, SystemContext& to) {
    if (_setjmp(from.registers) != 0) {
        return;
    }
    if (std::exchange(to.begins, false)) {
        setcontext(&to.first);
        std::abort();  // it did not go there
    }
    _longjmp(to.registers, 1);
}

/// At the beginning of `body`, which never returns.
inline void make_context_at(SystemContext& place, const Stack& stack, void (*body)()) {
    prepare(place.first, stack, body);
    place.begins = true;
}
#endif

}  // namespace raysteps::remote
