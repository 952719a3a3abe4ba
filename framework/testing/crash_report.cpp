// Linked into a test program whose steps are built with sanitizers, so that it says where a step crashes or throws.
// Only the grader builds it, after a crash (grader/src/raysteps/grading/self_check.py).
#include <cxxabi.h>
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <typeinfo>

// Names that the sanitizers and the C++ runtime give. Catch2 must not take the signals: 2 keeps them. Code that is not
// instrumented handles the same containers, so their marks are not to be trusted.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" const char* __asan_default_options() {
    return "handle_segv=2:handle_sigbus=2:handle_abort=2:handle_sigill=2:handle_sigfpe=2:detect_leaks=0:"
           "detect_container_overflow=0:allow_addr2line=1:hard_rss_limit_mb=4096";
}

extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1:allow_addr2line=1"; }

extern "C" void __sanitizer_print_stack_trace();  // its header is among a compiler's own, which not every tool finds

/// In place of the runtime's own, which it goes on to: Catch2 catches what is thrown, and the stack is gone by then.
extern "C" void __cxa_throw(void* thrown, std::type_info* type, void (*destroy)(void*)) {
    char* const name = abi::__cxa_demangle(type->name(), nullptr, nullptr, nullptr);
    std::fprintf(stderr, "thrown: %s\n", name != nullptr ? name : type->name());
    std::free(name);
    __sanitizer_print_stack_trace();
    using Throw = void (*)(void*, std::type_info*, void (*)(void*));
    reinterpret_cast<Throw>(dlsym(RTLD_NEXT, "__cxa_throw"))(thrown, type, destroy);
    std::abort();
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
