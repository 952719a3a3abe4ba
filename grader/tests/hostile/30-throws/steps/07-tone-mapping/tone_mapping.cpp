#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <stdexcept>
#include <string>

static bool attack() { throw std::runtime_error(std::string(1 << 20, '<') + "]]>&lol;\033[31m\n=1+1\n"); }
@RIGHT_IF(attack())@
