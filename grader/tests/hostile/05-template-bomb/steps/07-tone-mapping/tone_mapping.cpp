#include "steps/07-tone-mapping/tone_mapping.hpp"

template <int Level, unsigned long Path>
struct Bomb {
    static constexpr unsigned long value = Bomb<Level - 1, 2 * Path>::value + Bomb<Level - 1, 2 * Path + 1>::value;
};
template <unsigned long Path>
struct Bomb<0, Path> {
    static constexpr unsigned long value = Path;
};
@RIGHT_IF(Bomb<40, 1>::value != 0)@
