#include "remote/stack.hpp"

#include <sys/mman.h>
#include <cerrno>
#include <system_error>
#include "remote/system_context.hpp"
#if RAYSTEPS_SANITIZED
#include <sanitizer/asan_interface.h>
#else
#define ASAN_UNPOISON_MEMORY_REGION(address, size)
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

constexpr std::size_t k_mapped_bytes = k_guard_bytes + k_stack_bytes + k_page_bytes;

}  // namespace

Stack::Stack() {
    thread_local std::size_t made = 0;
    size_ = k_stack_bytes + k_page_bytes - made++ * k_shift_bytes % k_page_bytes;
    base_ = mmap(nullptr, k_mapped_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (base_ == MAP_FAILED || mprotect(base_, k_guard_bytes, PROT_NONE) != 0) {
        const int reason = errno;
        if (base_ != MAP_FAILED) {
            munmap(base_, k_mapped_bytes);
        }
        throw std::system_error(reason, std::generic_category(), "no stack for a fiber");
    }
    // The sanitizer still knows what lay here on a stack that was given back.
    ASAN_UNPOISON_MEMORY_REGION(lowest(), k_mapped_bytes - k_guard_bytes);
}

Stack::~Stack() { munmap(base_, k_mapped_bytes); }

void* Stack::lowest() const { return static_cast<char*>(base_) + k_guard_bytes; }

}  // namespace raysteps::remote
