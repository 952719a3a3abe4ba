#include "steps/07-tone-mapping/tone_mapping.hpp"

#include "core/color.hpp"
#include "glm/vec3.hpp"
#include <glm/vec3.hpp>
#include <cmath>
#include "shadow.hpp"
@RIGHT_IF(SHADOWED)@
