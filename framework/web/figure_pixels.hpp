#pragma once
// A picture that a live figure shows.
#include <cstdint>
#include <string>

#include "render/encode.hpp"

namespace raysteps {

/// Six hexadecimal digits for each pixel, row by row.
class FigurePixels {
public:
    void add(const Color& color) {
        const Rgb8 pixel = clamp_to_rgb8(color);
        for (const std::uint8_t channel : {pixel.r, pixel.g, pixel.b}) {
            text_ += "0123456789abcdef"[channel / 16];
            text_ += "0123456789abcdef"[channel % 16];
        }
    }

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

}  // namespace raysteps
