#include "render/spd.hpp"

#include <glm/geometric.hpp>
#include <mutex>

#include "core/scene_query.hpp"
#include "core/threads.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/04-shadows/shadows.hpp"
#include "steps/05-reflection/reflection.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {
namespace {

constexpr int k_corners = 513;
constexpr int k_max_depth = 5;

/// Each row of rays has its own.
class SpdCounter {
public:
    SpdCounter(const Scene& scene, const Accelerator& accelerator)
        : scene_(scene), accelerator_(accelerator), shadow_query_(accelerator, thread_stats().shadow) {}

    void eye_ray(const Ray& ray) {
        ++thread_stats().eye;
        thread_stats().eye_hit += follow(ray, 1) ? 1U : 0U;
    }

private:
    /// Counts everything that the ray brings about; whether it met a surface.
    bool follow(const Ray& ray, int depth) {
        const std::optional<HitRecord> hit = accelerator_.closest_hit(ray);
        if (!hit) {
            return false;
        }
        for (const Light& light : scene_.lights) {
            if (glm::dot(light.position - hit->position, hit->normal) > 0.0F) {
                static_cast<void>(is_lit(shadow_query_, *hit, light));
            }
        }
        if (depth < k_max_depth) {
            bounce(*hit, depth);
        }
        return true;
    }

    void bounce(const HitRecord& hit, int depth) {
        if (hit.fill.ks > 0.0F || hit.fill.transmittance > 0.0F) {
            ++thread_stats().reflect;
            follow(reflected_ray(hit), depth + 1);
        }
        if (hit.fill.transmittance > 0.0F) {
            ++thread_stats().refract;
            const Ray ray = transmitted_ray(hit);
            const bool passes_through = glm::dot(ray.direction, hit.normal) < 0.0F;
            if (passes_through) {  // else it is the mirrored ray once more
                follow(ray, depth + 1);
            }
        }
    }

    const Scene& scene_;
    const Accelerator& accelerator_;
    CountingQuery shadow_query_;
};

Ray corner_ray(const Camera& camera, const ViewFrame& frame, int column, int row) {
    constexpr float k_stretch = 512.0F / 511.0F;  // the angle spans the centres of the outer pixel rows
    const float across = k_stretch * (2.0F * static_cast<float>(column) / (k_corners - 1) - 1.0F);
    const float upwards = k_stretch * (1.0F - 2.0F * static_cast<float>(row) / (k_corners - 1));
    return {camera.from, glm::normalize(frame.forward + across * frame.half_height * frame.right +
                                        upwards * frame.half_height * frame.up)};
}

}  // namespace

Stats count_spd_rays(const Scene& scene, const Accelerator& accelerator, int threads) {
    const ViewFrame frame = view_frame(scene.camera);
    std::mutex mutex;
    Stats total;
    share_among_threads(threads, k_corners, 1, [&](std::size_t row) {
        thread_stats() = Stats{};
        SpdCounter counter(scene, accelerator);
        for (int column = 0; column < k_corners; ++column) {
            counter.eye_ray(corner_ray(scene.camera, frame, column, static_cast<int>(row)));
        }
        const std::scoped_lock lock(mutex);
        total += thread_stats();
    });
    return total;
}

}  // namespace raysteps
