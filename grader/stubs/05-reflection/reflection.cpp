#include "steps/05-reflection/reflection.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    // TODO: Mirror the direction that arrived, and start a little off the surface.
    RAYSTEPS_TODO("05-reflection", "reflected_ray");
    return Ray{hit.position, hit.normal};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    // TODO: Stop at the depth limit, deal with a miss, and add the mirrored colour to the light of the hit itself.
    RAYSTEPS_TODO("05-reflection", "trace");
    return k_black;
}

}  // namespace raysteps
