#include "inspect/inspect_pixel.hpp"

#include <utility>
#include <vector>

#include "inspect/ray_recorder.hpp"
#include "render/encode.hpp"
#include "render/film_sampler.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps {
namespace {

constexpr std::size_t k_max_near = 2000;  // surfaces that are described

/// Surfaces in the order in which somebody who draws the pixel needs them, each once.
class NearList {
public:
    NearList(const SurfaceList& surfaces, std::vector<SurfaceInfo>& list)
        : surfaces_(surfaces), list_(list), taken_(surfaces.size(), false) {}

    void add(std::size_t order) {
        if (order < taken_.size() && !taken_[order] && list_.size() < k_max_near) {
            taken_[order] = true;
            list_.push_back(describe(*surfaces_[order]));
        }
    }

    void add_hits(const RayNode& node) {
        if (node.hit && node.hit->surface) {
            add(*node.hit->surface);
        }
        if (node.lost) {
            add(node.lost->surface);
        }
    }

    void add_tests(const RayNode& node) {
        for (const SurfaceEvent& event : node.tests) {
            add(event.surface);
        }
    }

private:
    const SurfaceList& surfaces_;
    std::vector<SurfaceInfo>& list_;
    std::vector<bool> taken_;
};

template <typename Visit>
void for_each_ray(const RayNode& node, const Visit& visit) {
    visit(node);
    const auto visit_all = [&visit](const std::list<RayNode>& rays) {
        for (const RayNode& ray : rays) {
            for_each_ray(ray, visit);
        }
    };
    for (const LightRecord& light : node.lights) {
        visit_all(light.rays);
    }
    for (const LampRecord& lamp : node.lamps) {
        visit_all(lamp.rays);
    }
    visit_all(node.bounces);
}

void list_near(const Scene& scene, PixelRecord& record) {
    NearList near(scene.surfaces(), record.near);
    for_each_ray(record.eye, [&](const RayNode& node) { near.add_hits(node); });
    for_each_ray(record.eye, [&](const RayNode& node) { near.add_tests(node); });
    for (std::size_t i = 0; i < scene.surfaces().size() && record.near.size() < k_max_near; ++i) {
        near.add(i);
    }
}

/// The ray that is followed, and which random numbers its path takes.
std::pair<Ray, SampleId> primary_of(const PixelRecord& record) {
    if (!record.sample) {
        return {primary_ray(record.camera, record.frame, record.x, record.y), SampleId{}};
    }
    const Camera camera = camera_of_step(record.camera, record.options.step);
    const FilmSampler sampler(camera, k_max_sample_side, SamplingOptions{});
    const auto index = static_cast<std::uint32_t>(*record.sample - 1);
    const FilmSampler::Primary primary = sampler.halton_sample(record.x, record.y, index);
    return {primary.ray, primary.sample};
}

}  // namespace

PixelRecord inspect_pixel(const Scene& scene, const Camera& camera, const Accelerator& accelerator,
                          Acceleration acceleration, const StepOptions& options, int x, int y,
                          std::optional<int> sample) {
    PixelRecord record;
    record.options = options;
    record.acceleration = acceleration;
    record.camera = camera;
    record.frame = view_frame(camera);
    record.background = scene.background;
    record.lights = scene.lights;
    record.area_lights = has_area_lights(options.step) ? scene.area_lights.size() : 0;
    record.structure = accelerator.size();
    record.surfaces = scene.surfaces().size();
    record.x = x;
    record.y = y;
    record.sample = sample;

    thread_stats() = Stats{};
    const auto [ray, id] = primary_of(record);
    record.eye.ray = ray;
    RayRecorder rays(scene, accelerator, record);
    try {
        record.color = make_integrator(scene, rays, options)->primary_color(ray, id);
    } catch (const EndlessRays&) {
        record.endless = true;
    }
    record.eye.color = record.color;
    rays.finish();
    record.stats = thread_stats();
    if (record.color) {
        record.bytes = encode(*record.color, options.step);
        if (options.step >= 7) {
            record.mapped = shown_color(*record.color, options.step);
        }
    }
    list_near(scene, record);
    return record;
}

}  // namespace raysteps
