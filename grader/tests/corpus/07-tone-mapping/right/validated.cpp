#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace raysteps {

Color tone_map(const Color& color) {
    const glm::bvec3 lit = glm::greaterThan(color, Color(0.0F));  // false for NaN
    const glm::bvec3 endless = glm::isinf(color);
    Color c = glm::mix(Color(0.0F), color, lit);
    c = glm::mix(c, Color(0.0F), endless);
    const Color curve = c / (1.0F + c);
    return glm::mix(curve, Color(1.0F), glm::bvec3(lit.x && endless.x, lit.y && endless.y, lit.z && endless.z));
}

std::uint8_t to_byte(float channel) {
    if (!std::isfinite(channel)) {
        return channel > 0.0F ? 255 : 0;
    }
    int level = 0;
    if (channel >= 1.0F) {
        level = 255;
    } else if (channel > 0.0F) {
        const double exact = 255.0 * channel;
        level = static_cast<int>(exact);
        if (exact - level >= 0.5) {
            ++level;
        }
    }
    return static_cast<std::uint8_t>(level);
}

}  // namespace raysteps
