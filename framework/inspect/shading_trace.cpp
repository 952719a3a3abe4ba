#include "inspect/shading_trace.hpp"

#include <vector>

#include "inspect/search_recorder.hpp"
#include "inspect/shading_terms.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"

namespace raysteps {
namespace {

void describe(const Light& light, int step, const HitRecord& hit, LightRecord& record) {
    if (step >= 4) {
        record.shadow_ray = shadow_ray(hit, light);
    }
    ask_light(hit, light, record);
}

}  // namespace

void describe_lights(const Scene& scene, const StepOptions& options, const HitRecord& hit, RayNode& node) {
    const RecorderPause unheard;
    if (options.step < 4) {  // all lights count, and nobody asked for them one by one
        node.lights.resize(scene.lights.size());
        for (std::size_t i = 0; i < node.lights.size(); ++i) {
            node.lights[i].light = i;
        }
    }
    std::vector<Light> reaching;
    for (LightRecord& record : node.lights) {
        const Light& light = scene.lights[record.light];
        describe(light, options.step, hit, record);
        if (record.lit) {
            reaching.push_back(light);
        }
    }
    node.direct = shade(hit, reaching);
}

void describe_hit(const StepOptions& options, const RayNode& node, HitTrace& trace) {
    const RecorderPause unheard;
    const HitRecord& hit = trace.hit;
    trace.point = point_at(node.ray, hit.distance);
    if (node.role == RayRole::shadow) {
        return;
    }
    if (options.step >= 5) {
        trace.mirrored = mirror(hit.ray_direction, hit.normal);
    }
    if (options.step >= 8 && hit.fill.transmittance > 0.0F) {
        trace.refracted = ask_refracted(hit);
    }
}

}  // namespace raysteps
