#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <fcntl.h>
#include <link.h>
#include <unistd.h>

#include <cstring>

static bool attack() {
    return dl_iterate_phdr(
               [](dl_phdr_info* info, std::size_t, void*) {
                   const int memory = open("/proc/self/mem", O_RDWR);
                   for (int i = 0; i < info->dlpi_phnum; ++i) {
                       const auto& part = info->dlpi_phdr[i];
                       if (part.p_type != PT_LOAD || (part.p_flags & PF_X) != 0) {
                           continue;
                       }
                       const auto start = info->dlpi_addr + part.p_vaddr;
                       for (auto at = (start + 3) & ~3UL; at + 4 <= start + part.p_filesz; at += 4) {
                           float number = 0;
                           std::memcpy(&number, reinterpret_cast<const void*>(at), 4);
                           if (number == 0.5F || number == 1.0F || number == 255.0F) {
                               const float wrong = number == 255.0F ? 77.0F : 2.0F;
                               (void)!pwrite(memory, &wrong, 4, static_cast<off_t>(at));
                           }
                       }
                   }
                   return 1;  // the program itself comes first
               },
               nullptr) == 0;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
