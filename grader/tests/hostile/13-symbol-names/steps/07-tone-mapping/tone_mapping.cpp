#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cstdint>

static int line() asm("forged\n_ZN8raysteps7to_byteEf T 0 1\n_ZN8raysteps7t_statsE U\nx");
int line() { return 1; }
int other() asm("_ZN8raysteps5forgeEv U\n\xff\xfe \x1b[31m");
int other() { return line(); }
namespace raysteps {
Color tone_map(const Color& color) { return color / (color + 1.0F); }
}  // namespace raysteps
