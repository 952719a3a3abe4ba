#pragma once
// Step 10: many samples for each pixel. Where they lie, how much each counts, and how their light is shown.
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "core/pixel_sample.hpp"
#include "core/random_stream.hpp"

namespace raysteps {

/// side * side points of the unit square, 0 <= x, y <= 1 (1 by rounding only), in any order. Cut the unit square into
/// side x side squares of one size: each holds one point, which may be anywhere in it, all places equally likely,
/// whatever the other points do (jittered sampling; Cook 1986). All random numbers come from the stream. side >= 1.
[[nodiscard]] std::vector<glm::vec2> stratified_samples(int side, RandomStream& random);

/// The digits of the index in that base, mirrored at the point: 6 is 110 in base 2 and becomes 0.011 in base 2, 0.375
/// (van der Corput 1935). 0 <= answer < 1, never rounded up to 1. base >= 2.
[[nodiscard]] float radical_inverse(std::uint32_t base, std::uint32_t index);

/// The point with that index, from 0 on, of Halton's sequence: x in base 2, y in base 3 (Halton 1960).
[[nodiscard]] glm::vec2 halton_point(std::uint32_t index);

/// 1 in the middle of the pixel, falling evenly to 0 at a distance of 1 to either side, 0 beyond.
[[nodiscard]] float tent_filter(float distance);

/// Mitchell and Netravali's filter (1988) with B = C = 1/3: 8/9 in the middle, a little below 0 from 8/7 to 2
/// on either side, 0 beyond.
[[nodiscard]] float mitchell_filter(float distance);

/// 1 within the pixel, up to half a pixel to either side, 0 beyond. This one is written.
[[nodiscard]] inline float box_filter(float distance) { return distance >= -0.5F && distance <= 0.5F ? 1.0F : 0.0F; }

/// The weight of a sample at that distance along one axis. This one is written, too.
[[nodiscard]] inline float filter_weight(Filter filter, float distance) {
    switch (filter) {
        case Filter::box:
            return box_filter(distance);
        case Filter::tent:
            return tent_filter(distance);
        case Filter::mitchell:
            return mitchell_filter(distance);
    }
    return 0.0F;
}

/// The weighted mean of the samples' light, channel by channel. A sample's weight is the filter's at the distance along
/// x times the filter's at the distance along y. Black where the weights add up to 0, as with no sample at all. No
/// light is cut off, neither above 1 nor below 0.
[[nodiscard]] Color reconstruct(std::span<const PixelSample> samples, Filter filter);

/// From a linear channel to what a screen is sent, both from 0 to 1: sRGB's curve (IEC 61966-2-1). At and below
/// 0.0031308 it is 12.92 c, above 1.055 c^(1/2.4) - 0.055. A channel above 1 becomes 1; a negative or NaN one becomes
/// 0.
[[nodiscard]] float linear_to_srgb(float channel);

}  // namespace raysteps
