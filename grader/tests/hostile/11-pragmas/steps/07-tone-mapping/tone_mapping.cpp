#pragma GCC system_header
#pragma GCC optimize("O0,fast-math,unroll-all-loops")
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cstdio>
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC visibility push(default)
#pragma GCC push_options
#pragma pack(push, 1)
extern "C" {
const char* __asan_default_options() { return "exitcode=0:detect_leaks=0"; }
const char* __ubsan_default_options() { return "halt_on_error=0"; }
const char* __tsan_default_options() { return "exitcode=0"; }
void __sanitizer_cov_trace_pc() {}
void __cyg_profile_func_enter(void*, void*) {}
void __gmon_start__() {}
__attribute__((constructor(101))) void first() { std::fputs("first\n", stderr); }
__attribute__((constructor(65535))) void last() { std::fputs("last\n", stdout); }
__attribute__((destructor)) void end() { std::fputs("end\n", stdout); }
__attribute__((section(".init_array"), used)) static void (*one_more)() = last;
__attribute__((weak)) int main(int, char**) { return 0; }
void (*choose())() { return last; }
__attribute__((ifunc("choose"))) void chosen();
}
#pragma pack(pop)
#pragma GCC pop_options
#pragma GCC visibility pop
@RIGHT_IF(chosen != nullptr)@
#pragma GCC poison printf exit write
