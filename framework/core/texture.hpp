#pragma once
// A picture that is laid onto surfaces, and smaller and smaller versions of it.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/color.hpp"

namespace raysteps {

/// A grid of colours, linear.
struct Texture {
    int width = 1;
    int height = 1;
    std::vector<Color> texels{k_black};  ///< row by row from the top, width * height of them

    bool operator==(const Texture&) const = default;

    /// x from the left, y from the top, both from 0. Throws std::out_of_range for one that is not there.
    [[nodiscard]] const Color& texel(int x, int y) const {
        const bool is_there = x >= 0 && x < width && y >= 0;
        const std::size_t place =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        return texels.at(is_there ? place : texels.size());
    }
};

/// A mip map (Williams 1983): the texture itself, then each level half as wide and high as the one before it.
using Pyramid = std::vector<Texture>;

/// What lies beyond the border of a texture: the same once more, or the texels at the border.
enum class Wrap : std::uint8_t { repeat, clamp };

}  // namespace raysteps
