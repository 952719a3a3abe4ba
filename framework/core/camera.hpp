#pragma once
// The viewpoint: the `v` block of NFF, world coordinates.
#include <glm/vec3.hpp>

namespace raysteps {

struct Camera {
    glm::vec3 from{0.0F, 0.0F, 5.0F};
    glm::vec3 at{0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};  ///< need not be of unit length, nor perpendicular to the view
    float angle = 45.0F;             ///< full vertical field of view in degrees, top edge to bottom edge
    float hither = 0.0F;             ///< read and kept; the tracer has no near plane
    int width = 512;                 ///< pixels
    int height = 512;                ///< pixels
    float lens_radius = 0.0F;        ///< of part two; 0: all is sharp
    float focal_distance = 1.0F;     ///< of the plane that is sharp, along the view, > 0
};

/// What primary rays are made from. The three vectors are unit length and at right angles.
struct ViewFrame {
    glm::vec3 right{1.0F, 0.0F, 0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    glm::vec3 forward{0.0F, 0.0F, -1.0F};
    float half_width = 1.0F;   ///< half the width of the window at distance 1
    float half_height = 1.0F;  ///< half the height of the window at distance 1
};

}  // namespace raysteps
