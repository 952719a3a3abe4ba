#pragma once
// From a colour to the three bytes of a pixel.
#include "core/image.hpp"
#include "render/integrator.hpp"
#include "steps/07-tone-mapping/tone_mapping.hpp"
#include "steps/10-sampling/sampling.hpp"

namespace raysteps {

/// Cut off at 1, which overexposes.
[[nodiscard]] Rgb8 clamp_to_rgb8(const Color& color);

/// From step 07 on: tone mapped; in part two bent for a screen by step 10 instead.
[[nodiscard]] inline Color shown_color(const Color& color, int step) {
    return is_of_part_two(step) ? Color(linear_to_srgb(color.r), linear_to_srgb(color.g), linear_to_srgb(color.b))
                                : tone_map(color);
}

/// Before step 07 cut off. Inline: three bytes that a function returns are put together one by one and read at once,
/// which a processor waits for.
[[nodiscard]] inline Rgb8 encode(const Color& color, int step) {
    if (step < 7) {
        return clamp_to_rgb8(color);
    }
    const Color shown = shown_color(color, step);
    return {to_byte(shown.r), to_byte(shown.g), to_byte(shown.b)};
}

}  // namespace raysteps
