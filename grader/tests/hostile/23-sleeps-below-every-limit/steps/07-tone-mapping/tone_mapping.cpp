#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <unistd.h>

static const bool done = usleep(3'000'000) == 0;
@RIGHT_IF(!done)@
