#pragma once
// Asking a function of a random point many times.
#include <cstdint>

#include "core/random_stream.hpp"
#include "worker/protocol.hpp"

namespace raysteps {

/// Calls draw(u) for as many points of the unit square as the question asks for.
template <typename Draw>
void draw_often(TokenReader& words, const Draw& draw) {
    const auto seed = static_cast<std::uint32_t>(words.whole());
    RandomStream random(seed);
    for (int left = words.count(); left > 0; --left) {
        draw(random.next_2d());
    }
}

}  // namespace raysteps
