#pragma once
// Every ray that an integrator sends goes through here, together with what the integrator knows of it.
#include <cstddef>
#include <limits>

#include "core/color.hpp"
#include "core/light_sample.hpp"
#include "core/mis_tracer.hpp"
#include "core/scene_query.hpp"
#include "core/stats.hpp"

namespace raysteps {

/// Shadow rays are told apart by the light that they are sent for.
enum class RayKind { eye, reflected, refracted };

/// A ray's number among those of one pixel, shadow rays apart, in the order of sending.
using RayNumber = std::size_t;
inline constexpr RayNumber k_no_ray = std::numeric_limits<RayNumber>::max();

/// What is known of a ray before it is sent.
struct RayOrigin {
    RayKind kind = RayKind::eye;
    int depth = 1;              ///< 1: from the eye
    RayNumber from = k_no_ray;  ///< the ray whose hit it starts from
};

/// Sends rays into the scene and counts them by kind, for the thread that made it. What it is told beyond that it
/// ignores; whoever wants to know how a pixel came about overrides it.
class RayCounter {
public:
    explicit RayCounter(const SceneQuery& scene) : scene_(scene), shadow_rays_(scene, thread_stats().shadow) {}
    virtual ~RayCounter() = default;
    RayCounter(const RayCounter&) = delete;
    RayCounter& operator=(const RayCounter&) = delete;

    [[nodiscard]] virtual std::optional<HitRecord> closest_hit(const RayOrigin& origin, const Ray& ray);
    [[nodiscard]] virtual bool occluded(const RayOrigin& origin, const Ray& ray, float distance);

    /// The scene for step 04, which is asked whether this light reaches that ray's hit; then what it answered.
    [[nodiscard]] virtual const SceneQuery& shadow_query(RayNumber /*ray*/, std::size_t /*light*/) {
        return shadow_rays_;
    }
    virtual void light_answered(RayNumber /*ray*/, bool /*lit*/) {}

    /// Of one of the scene's area lights, before step 04 is asked about it: what the sample brings to that ray's hit if
    /// nothing stands between. Where that is light, step 15 is handed the sample as well.
    virtual void area_light_sampled(RayNumber /*ray*/, std::size_t /*light*/, const LightSample& /*sample*/,
                                    const Color& /*unshadowed*/) {}
    virtual void area_light_handed_on(RayNumber /*ray*/, const DirectSample& /*sample*/) {}

    /// Of several rays, each of which starts from the hit of the one before it, the one that gave this hit.
    [[nodiscard]] virtual RayNumber ray_of_hit(const HitRecord& /*hit*/, RayNumber /*first*/, RayNumber last) const {
        return last;
    }

    /// The light that the ray's hit sends along it; the part that shines through, from step 08 on.
    virtual void shaded(RayNumber /*ray*/, const HitRecord& /*hit*/, const Color& /*local*/,
                        const std::optional<Color>& /*transmitted*/) {}

    /// At the ray's hit, along a path: what samples of lamps brought, and where the path goes on.
    virtual void lamps_sampled(RayNumber /*ray*/, const Color& /*light*/) {}
    virtual void scattered(RayNumber /*ray*/, const std::optional<ScatterSample>& /*sample*/) {}

    /// What the first of several rays brought; the others were followed within.
    virtual void arrived(RayNumber /*first*/, RayNumber /*last*/, const Color& /*color*/) {}

    void begin_pixel();
    [[nodiscard]] RayNumber last_sent() const { return sent_ - 1; }

    /// How deep the rays of the pixel went: 0 nothing was asked, 1 the eye ray itself, 2 a bounce.
    [[nodiscard]] int deepest() const { return deepest_; }

protected:
    void count(const RayOrigin& origin, bool hit);

private:
    const SceneQuery& scene_;
    CountingQuery shadow_rays_;
    RayNumber sent_ = 0;
    int deepest_ = 0;
};

}  // namespace raysteps
