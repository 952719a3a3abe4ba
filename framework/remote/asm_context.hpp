#pragma once
// A place on a stack to go on from, for processors of x86-64: a few instructions change from one to another. Where
// RAYSTEPS_ASM_CONTEXT is 0 there is none, and the system's (system_context.hpp) serves.
#include "remote/stack.hpp"

#if defined(__x86_64__) && defined(__LP64__) && !defined(__AVX512F__)
#define RAYSTEPS_ASM_CONTEXT 1

namespace raysteps::remote {

/// What a function must find as it left it, the compiler keeps on the stack: it is told that all else is lost. Of the
/// registers of AVX-512 it is not told: a build for those has no such place.
struct AsmContext {
    void* stack;
    void* frame;
    void* next;  ///< instruction
};

/// Goes to `to`, and returns when somebody changes to `from`.
inline void switch_context(AsmContext& from, AsmContext& to) {
    // NOLINTBEGIN(misc-const-correctness): the instructions write there
    AsmContext* left = &from;
    AsmContext* entered = &to;
    // NOLINTEND(misc-const-correctness)
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

/// At the beginning of `body`, which never returns.
inline void make_context_at(AsmContext& place, const Stack& stack, void (*body)()) {
    auto* top = reinterpret_cast<void**>(static_cast<char*>(stack.lowest()) + stack.size());
    top[-1] = nullptr;  // where a caller's address would be: the stack ends here
    place = {.stack = static_cast<void*>(top - 1), .frame = nullptr, .next = reinterpret_cast<void*>(body)};
}

}  // namespace raysteps::remote

#else
#define RAYSTEPS_ASM_CONTEXT 0
#endif
