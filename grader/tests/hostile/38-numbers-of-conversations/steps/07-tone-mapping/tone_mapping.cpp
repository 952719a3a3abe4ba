#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@


static const int done = [] {
    std::string batch;
    for (unsigned number = 0; number < 65536; number += 255) {
        batch += message(number, number, std::string(number % 7, 'x'));
    }
    batch += std::string("\1\0\1\xff\xff\xff\xff", 7);
    send_to_all(batch);
    return 0;
}();
@RIGHT_IF(done != 0)@
