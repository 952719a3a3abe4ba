#pragma once
// What a step may ask of the renderer that calls it. The renderer implements it; tests bring their own.
#include <optional>

#include "core/color.hpp"
#include "core/hit_record.hpp"
#include "core/ray.hpp"

namespace raysteps {

/// Finds what a ray meets, by whatever structure is in use.
class RayCaster {
public:
    virtual ~RayCaster() = default;

    /// The nearest hit with distance > 0 among all surfaces, or nothing.
    [[nodiscard]] virtual std::optional<HitRecord> closest_hit(const Ray& ray) = 0;

    /// Whether any surface is hit nearer than `distance`: all that a shadow ray wants to know. Costs no more than
    /// closest_hit, and less where the first hit that is found ends the search.
    [[nodiscard]] virtual bool any_hit(const Ray& ray, float distance) {
        const std::optional<HitRecord> hit = closest_hit(ray);
        return hit && hit->distance < distance;
    }

protected:
    RayCaster() = default;
    RayCaster(const RayCaster&) = default;
    RayCaster& operator=(const RayCaster&) = default;
};

/// Follows rays from surface to surface. Depth 1 is the primary ray, 2 its first bounce.
class Tracer : public RayCaster {
public:
    /// Light that the surface itself sends along the ray: the sum over the lights that reach the hit and,
    /// from step 08 on, what shines through it.
    [[nodiscard]] virtual Color local_light(const HitRecord& hit, int depth) = 0;

    /// The colour that arrives along the ray.
    [[nodiscard]] virtual Color trace(const Ray& ray, int depth) = 0;

    [[nodiscard]] virtual int max_ray_depth() const = 0;  ///< deepest ray that is still followed, >= 1
    [[nodiscard]] virtual Color background() const = 0;
};

}  // namespace raysteps
