// own sums in double, start nearly as far off as allowed
#include "steps/04-shadows/shadows.hpp"
#include <cmath>

namespace raysteps {

static double way_to(const glm::vec3& from, const glm::vec3& to, double way[3])
{
    double squares = 0.0;
    for (int i = 0; i < 3; ++i) {
        way[i] = (double)to[i] - (double)from[i];
        squares += way[i] * way[i];
    }
    return std::sqrt(squares);
}

Ray shadow_ray(const HitRecord& hit, const Light& light)
{
    const double epsilon = 0.009;
    Ray ray;
    for (int i = 0; i < 3; ++i) {
        ray.origin[i] = (float)(hit.position[i] + epsilon * hit.normal[i]);
    }
    double way[3];
    double length = way_to(ray.origin, light.position, way);
    for (int i = 0; i < 3; ++i) {
        ray.direction[i] = (float)(way[i] / length);
    }
    return ray;
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light)
{
    Ray ray = shadow_ray(hit, light);
    double way[3];
    double length = way_to(ray.origin, light.position, way);
    return scene.occluded(ray, (float)length) == false;
}

}
