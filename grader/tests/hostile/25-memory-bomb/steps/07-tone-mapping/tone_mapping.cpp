#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cstdlib>
#include <cstring>

static bool attack() {
    std::size_t had = 0;
    for (; had < 3000; had += 50) {
        void* piece = std::malloc(50U << 20U);
        if (piece == nullptr) {
            break;
        }
        std::memset(piece, 7, 50U << 20U);
    }
    return had > 1000;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
