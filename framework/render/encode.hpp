#pragma once
// From a colour to the three bytes of a pixel.
#include "core/image.hpp"
#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps {

/// Cut off at 1, which overexposes.
[[nodiscard]] Rgb8 cut_off(const Color& color);

/// From step 07 on by the step's tone mapping; before that cut off. Inline: three bytes that a function returns are put
/// together one by one and read at once, which a processor waits for.
[[nodiscard]] inline Rgb8 encode(const Color& color, int step) {
    if (step < 7) {
        return cut_off(color);
    }
    const Color mapped = tone_map(color);
    return {to_byte(mapped.r), to_byte(mapped.g), to_byte(mapped.b)};
}

}  // namespace raysteps
