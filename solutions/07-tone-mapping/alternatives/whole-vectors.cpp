// The colour is mapped as one vector, and what is no proper number is put right by masks before and after. Bytes are
// rounded by the processor's own rounding (lrint).
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace raysteps {

Color tone_map(const Color& color) {
    const glm::bvec3 is_light = glm::greaterThan(color, Color(0.0F));  // false for NaN
    const Color light = glm::mix(Color(0.0F), color, is_light);
    const Color mapped = light / (light + 1.0F);
    return glm::mix(mapped, Color(1.0F), glm::isinf(light));
}

std::uint8_t to_byte(float channel) {
    float level = channel * 255.0F;
    if (!(level > 0.0F)) {
        level = 0.0F;
    }
    if (level > 255.0F) {
        level = 255.0F;
    }
    return static_cast<std::uint8_t>(std::lrint(level));
}

}  // namespace raysteps
