#pragma once
// One of the rays of a pixel, and how much each of them counts.
#include <cstdint>
#include <glm/vec2.hpp>

#include "core/color.hpp"

namespace raysteps {

struct PixelSample {
    glm::vec2 offset{0.0F};  ///< from the middle of the pixel, in pixels: x to the right, y down
    Color light{0.0F};       ///< that arrives along the ray, linear
};

/// How a sample's weight falls with its distance from the middle of the pixel.
enum class Filter : std::uint8_t { box, tent, mitchell };

}  // namespace raysteps
