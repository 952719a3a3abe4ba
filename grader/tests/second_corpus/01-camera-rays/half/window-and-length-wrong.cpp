#include "steps/01-camera-rays/camera_rays.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

using namespace glm;

namespace raysteps {

vec3 point_at(const Ray& ray, float distance) { return ray.origin + distance * ray.direction; }

ViewFrame view_frame(const Camera& camera)
{
    const vec3 f = normalize(camera.at - camera.from);
    const vec3 r = normalize(cross(f, camera.up));
    const vec3 u = cross(r, f);

    const float h = tan(radians(camera.angle));
    const float aspect = static_cast<float>(camera.width / camera.height);

    return ViewFrame{r, u, f, h * aspect, h};
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y)
{
    const float across = 2.0F * (static_cast<float>(x) + 0.5F) / static_cast<float>(camera.width) - 1.0F;
    const float upwards = 1.0F - 2.0F * (static_cast<float>(y) + 0.5F) / static_cast<float>(camera.height);
    return {camera.from,
            frame.forward + across * frame.half_width * frame.right + upwards * frame.half_height * frame.up};
}

}  // namespace raysteps
