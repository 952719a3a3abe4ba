#include "worker/scripted_tracer.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "steps/02-intersection/intersection.hpp"
#include "steps/05-reflection/reflection.hpp"

namespace raysteps {

std::optional<HitRecord> ListQuery::closest_hit(const Ray& ray) const { return raysteps::closest_hit(surfaces_, ray); }

// Position and side follow the ray that really came, so that a record is never at odds with it.
std::optional<HitRecord> ScriptedTracer::closest_hit(const Ray& ray) const {
    const std::size_t number = calls_.cast.size();
    calls_.cast.push_back(ray);
    if (number >= script_.hits.size()) {
        return std::nullopt;
    }
    const ScriptedHit& scripted = script_.hits[number];
    HitRecord hit;
    hit.position = ray.origin + scripted.distance * ray.direction;
    // What is mirrored keeps its hue, whatever the colour of the mirror; and that is not the light which it sends.
    hit.fill.color = {scripted.local.g, scripted.local.b, scripted.local.r};
    hit.fill.ks = scripted.ks;
    // Nothing else about the surface matters to what it mirrors, so all of it changes from hit to hit.
    const float varied = scripted.distance - std::floor(scripted.distance);
    hit.fill.kd = varied;
    hit.fill.shine = 1.0F + 40.0F * varied;
    hit.fill.transmittance = varied < 0.4F ? 0.0F : varied;
    hit.fill.index_of_refraction = 1.0F + varied;
    hit.front_face = varied < 0.6F;
    hit.normal = glm::dot(scripted.normal, ray.direction) <= 0.0F ? scripted.normal : -scripted.normal;
    hit.ray_direction = ray.direction;
    hit.distance = scripted.distance;
    return hit;
}

// The distances of a script differ, so that they tell which hit it is.
Color ScriptedTracer::direct_lighting(const HitRecord& hit, int depth) {
    calls_.shaded.push_back({hit.distance, depth});
    for (const ScriptedHit& scripted : script_.hits) {
        if (scripted.distance == hit.distance) {
            return scripted.local;
        }
    }
    return script_.own_light;
}

Color ScriptedTracer::trace(const Ray& ray, int depth) {
    calls_.traced.push_back({ray, depth});
    return script_.traced ? *script_.traced : raysteps::trace(*this, ray, depth);
}

}  // namespace raysteps
