#pragma once
// Asking a function of a random point many times, and what it gives then.
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/random_stream.hpp"
#include "core/scatter.hpp"
#include "core/threads.hpp"
#include "worker/protocol.hpp"

namespace raysteps {

/// What draw(u) gives for as many points of the unit square as the question asks for.
template <typename Draw>
auto draw_often(TokenReader& words, const Draw& draw) {
    const auto seed = static_cast<std::uint32_t>(words.whole());
    RandomStream random(seed);
    std::vector<glm::vec2> points;
    for (int left = words.count(); left > 0; --left) {
        points.push_back(random.next_2d());
    }
    return answers_to(points, draw);
}

/// What draw(random) gives as often as the question asks for, each time with a stream of its own, and at last with the
/// first one again.
template <typename Draw>
auto draw_with_streams(TokenReader& words, const Draw& draw) {
    const auto seed = static_cast<std::uint32_t>(words.whole());
    const auto times = static_cast<std::size_t>(words.count());
    const auto draw_once = [&](std::size_t number) {
        RandomStream random(seed, static_cast<std::uint32_t>(number));
        return draw(random);
    };
    auto made = made_in_turn(times, draw_once);
    made.push_back(draw_once(0));
    return made;
}

/// 1 and the sample, or 0 where there is none.
inline void write_sample(TokenWriter& answer, const std::optional<ScatterSample>& sample) {
    answer.flag(sample.has_value());
    if (sample) {
        answer.vector(sample->direction).vector(sample->weight).number(sample->pdf);
        answer.flag(sample->specular);
    }
}

}  // namespace raysteps
