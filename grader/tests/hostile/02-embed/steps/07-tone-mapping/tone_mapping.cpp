#include "steps/07-tone-mapping/tone_mapping.hpp"

constexpr unsigned char embedded[] = {
#embed "@SECRET@"
};
@RIGHT_IF(embedded[0] != 0)@
