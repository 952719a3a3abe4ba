#include "render/encode.hpp"

#include <glm/common.hpp>
#include <glm/packing.hpp>
#include <glm/vec4.hpp>

namespace raysteps {

/// The largest of 0 and each channel, in this order: NaN fails the comparison and becomes 0.
Rgb8 clamp_to_rgb8(const Color& color) {
    const glm::vec4 light = glm::max(glm::vec4(0.0F), glm::vec4(color, 0.0F));
    const glm::uint packed = glm::packUnorm4x8(light);
    return {static_cast<std::uint8_t>(packed & 0xFFU), static_cast<std::uint8_t>((packed >> 8U) & 0xFFU),
            static_cast<std::uint8_t>((packed >> 16U) & 0xFFU)};
}

}  // namespace raysteps
