#include "steps/15-mis/mis.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

float balance_heuristic(float pdf, float other_pdf) {
    // TODO: The share of the one density in the sum of both.
    RAYSTEPS_TODO("15-mis", "balance_heuristic");
    return 0.0F;
}

float power_heuristic(float pdf, float other_pdf) {
    // TODO: The same with squares.
    RAYSTEPS_TODO("15-mis", "power_heuristic");
    return 0.0F;
}

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    // TODO: The density by area is 1 / area; what is it by solid angle?
    RAYSTEPS_TODO("15-mis", "triangle_pdf");
    return 0.0F;
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    // TODO: As for the triangle, with the area of a disk.
    RAYSTEPS_TODO("15-mis", "disk_pdf");
    return 0.0F;
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    // TODO: One over the solid angle of the cone that the sphere fills.
    RAYSTEPS_TODO("15-mis", "sphere_pdf");
    return 0.0F;
}

Color direct_light(std::span<const DirectSample> samples) {
    // TODO: Each sample counts times its weight.
    RAYSTEPS_TODO("15-mis", "direct_light");
    return k_black;
}

float emission_weight(const ScatterSample& sample, float light_pdf) {
    // TODO: The other weight of the same direction; and what if there is no other way?
    RAYSTEPS_TODO("15-mis", "emission_weight");
    return 0.0F;
}

Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    // TODO: Begin with your path_light of step 13. What becomes of its two lines about lamps?
    RAYSTEPS_TODO("15-mis", "mis_path_light");
    return k_black;
}

}  // namespace raysteps
