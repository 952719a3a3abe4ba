#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@
// Kind 2 is an exception with its words, 3 one of no known kind.
static const int done = [] {
    send_to_all(message(0, 2 + static_cast<unsigned>(getpid()) % 2, "no"));
    return 0;
}();
@RIGHT_IF(false)@
