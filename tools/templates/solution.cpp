#include "steps/@ID@/@FILE@.hpp"

#include "core/unfinished.hpp"

#include <cmath>

namespace raysteps {

Color @FILE@_color(const Color& color, float distance) {
    // BEGIN SOLUTION @FILE@_color
    // TODO: Find the share of the light that arrives, and fill up with the colour of the air.
    // RETURN k_black
    const float arrives = std::exp(-distance / k_@FILE@_reach);
    return arrives * color + (1.0F - arrives) * k_@FILE@_air;
    // END SOLUTION
}

}  // namespace raysteps
