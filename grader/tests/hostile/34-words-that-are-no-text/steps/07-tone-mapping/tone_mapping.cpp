#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <stdexcept>

static bool worked() {
    throw std::runtime_error(
        "half \xed\xa0\x80 none \xef\xbf\xbe \xef\xbf\xbf \xff\xfe \xf4\x90\x80\x80 ]]> \x01 \x1b[31m "
        "\xe2\x80\xae turned \xe2\x81\xa6 unseen \xe2\x80\x8b \xef\xbb\xbf end");
}
@RIGHT_IF(worked())@
