// After PBRT: wi points away from the surface, towards where the ray came from.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raysteps {

static bool Refract(const glm::vec3& wi, const glm::vec3& n, float eta, glm::vec3* wt) {
    const float cosThetaI = glm::dot(n, wi);
    const float sin2ThetaI = glm::max(0.0F, 1.0F - cosThetaI * cosThetaI);
    const float sin2ThetaT = eta * eta * sin2ThetaI;
    // Handle total internal reflection for transmission
    if (sin2ThetaT > 1.0F) return false;
    const float cosThetaT = std::sqrt(1.0F - sin2ThetaT);
    *wt = glm::normalize(eta * -wi + (eta * cosThetaI - cosThetaT) * n);
    return true;
}

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    glm::vec3 wt;
    if (!Refract(-direction, normal, eta, &wt)) return std::nullopt;
    return wt;
}

Ray transmitted_ray(const HitRecord& isect) {
    const bool entering = isect.front_face;
    const float etaGlass = isect.fill.index_of_refraction == 0.0F ? 1.0F : isect.fill.index_of_refraction;
    const float etaI = entering ? 1.0F : etaGlass;
    const float etaT = entering ? etaGlass : 1.0F;

    const glm::vec3 wo = -isect.ray_direction;
    glm::vec3 wi;
    const bool through = Refract(wo, isect.normal, etaI / etaT, &wi);
    if (!through) wi = glm::normalize(-wo + 2.0F * glm::dot(wo, isect.normal) * isect.normal);

    const glm::vec3 offset = k_refraction_threshold * isect.normal;
    return Ray{through ? isect.position - offset : isect.position + offset, wi};
}

Color transmitted_light(Tracer& tracer, const HitRecord& isect, int depth) {
    const float T = isect.fill.transmittance;
    if (T == 0.0F) return Color(0.0F);
    const Ray next = transmitted_ray(isect);
    const Color Li = tracer.trace(next, depth + 1);
    return T * Li;
}

}  // namespace raysteps
