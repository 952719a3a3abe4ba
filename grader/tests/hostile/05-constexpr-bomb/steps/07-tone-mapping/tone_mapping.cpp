#include "steps/07-tone-mapping/tone_mapping.hpp"

template <unsigned Number>
constexpr unsigned work() {
    unsigned sum = Number;
    for (unsigned i = 0; i < 200'000; ++i) {
        sum = sum * 1664525U + 1013904223U;
    }
    return sum;
}
template <unsigned... Numbers>
struct List {};
template <unsigned... Numbers>
constexpr unsigned all(List<Numbers...>) {
    return (work<Numbers>() ^ ...);
}
template <unsigned Count, unsigned... Numbers>
struct Up : Up<Count - 1, Count, Numbers...> {};
template <unsigned... Numbers>
struct Up<0, Numbers...> {
    using type = List<Numbers...>;
};
constexpr unsigned result = all(Up<800>::type{});
@RIGHT_IF(result != 1)@
