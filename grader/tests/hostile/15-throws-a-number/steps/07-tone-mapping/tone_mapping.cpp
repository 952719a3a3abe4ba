#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps {

Color tone_map(const Color&) { throw 1; }
std::uint8_t to_byte(float) { throw 1; }

}  // namespace raysteps
