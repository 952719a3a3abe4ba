#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit)
{
    Ray out;
    out.direction = glm::normalize(mirror(hit.ray_direction, hit.normal));
    out.origin = hit.position + hit.normal * k_bounce_threshold;
    return out;
}

Color trace(Tracer& tracer, const Ray& ray, int depth)
{
    const auto first = tracer.closest_hit(ray);
    if (!first)
        return tracer.background();

    Color color = tracer.direct_lighting(*first, depth);
    if (first->fill.ks > 0.0F)
    {
        // what does the mirror show?
        const auto second = tracer.closest_hit(reflected_ray(*first));
        if (second)
            color += first->fill.ks * tracer.direct_lighting(*second, depth + 1);
    }
    return color;
}

}  // namespace raysteps
