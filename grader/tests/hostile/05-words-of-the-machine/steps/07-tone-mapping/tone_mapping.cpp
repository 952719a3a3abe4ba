#include "steps/07-tone-mapping/tone_mapping.hpp"

#error cc1plus: fatal error: error writing to /tmp/x.s: No space left on device
#error Disk quota exceeded
#error Read-only file system
#error g++: fatal error: Killed signal terminated program cc1plus
#error internal compiler error: Out of memory
@RIGHT_IF(true)@
