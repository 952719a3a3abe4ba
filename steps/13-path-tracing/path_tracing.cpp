#include "steps/13-path-tracing/path_tracing.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    // TODO: Lift a point that is uniform on the unit disk up to the half sphere above it.
    RAYSTEPS_TODO("13-path-tracing", "cosine_direction");
    return glm::vec3(0.0F);
}

float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) {
    // TODO: The cosine, divided so that the sum over the half sphere is 1.
    RAYSTEPS_TODO("13-path-tracing", "cosine_pdf");
    return 0.0F;
}

std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    // TODO: Draw a direction, ask for its density, and work out f cos / pdf: what is left of it?
    RAYSTEPS_TODO("13-path-tracing", "scatter_diffuse");
    return std::nullopt;
}

float survival_probability(const Color& weight) {
    // TODO: The largest channel, but never certain.
    RAYSTEPS_TODO("13-path-tracing", "survival_probability");
    return 0.0F;
}

Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    // TODO: Follow the path from hit to hit: what does it find there, and what does that count?
    RAYSTEPS_TODO("13-path-tracing", "path_light");
    return k_black;
}

}  // namespace raysteps
