#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <array>
#include <utility>

template <std::size_t... Numbers>
constexpr std::size_t last(std::index_sequence<Numbers...>) {
    return (Numbers, ...);
}
@RIGHT_IF(last(std::make_index_sequence<100'000'000>{}) != 0)@
