#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@
// Another number in each process: the first that is refused ends the program.
static const int done = [] {
    const unsigned numbers[] = {1, 7, 128, 511, 1023, 1024, 65535};
    const auto process = static_cast<unsigned>(getpid());
    send_to_all(message(numbers[process % 7], process / 7 % 5, std::string(process % 3, 'x')));
    return 0;
}();
@RIGHT_IF(done != 0)@
