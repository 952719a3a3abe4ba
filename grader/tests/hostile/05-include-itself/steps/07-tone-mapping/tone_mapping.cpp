#if __INCLUDE_LEVEL__ < 40
#include __FILE__
#include __FILE__
#endif
#include "steps/07-tone-mapping/tone_mapping.hpp"
@RIGHT_IF(true)@
