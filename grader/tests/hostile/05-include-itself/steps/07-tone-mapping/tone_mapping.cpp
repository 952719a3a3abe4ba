#include __FILE__
#include __FILE__
#include "steps/07-tone-mapping/tone_mapping.hpp"
@RIGHT_IF(true)@
