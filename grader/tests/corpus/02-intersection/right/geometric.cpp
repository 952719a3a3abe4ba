// Scratchapixel's geometric sphere, Ericson's scalar triple products
#include "steps/02-intersection/intersection.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace raysteps {

typedef glm::dvec3 Vec3d;

static double triple(const Vec3d& u, const Vec3d& v, const Vec3d& w)
{
    return glm::dot(glm::cross(u, v), w);
}

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const
{
    Vec3d orig(ray.origin), dir(ray.direction);
    // all three corners as seen from the origin of the ray
    Vec3d pa = Vec3d(a_) - orig;
    Vec3d pb = Vec3d(b_) - orig;
    Vec3d pc = Vec3d(c_) - orig;

    double u = triple(pb, pc, dir);
    double v = triple(pc, pa, dir);
    double w = triple(pa, pb, dir);
    bool allPositive = u >= 0 && v >= 0 && w >= 0;
    bool allNegative = u <= 0 && v <= 0 && w <= 0;
    if (!allPositive && !allNegative) return std::nullopt;

    Vec3d N = glm::cross(Vec3d(b_) - Vec3d(a_), Vec3d(c_) - Vec3d(a_));
    double NdotRayDirection = glm::dot(N, dir);
    if (NdotRayDirection == 0) return std::nullopt;   // parallel

    double t = glm::dot(N, pa) / NdotRayDirection;
    if (t <= 1e-6) return std::nullopt;               // behind

    HitRecord isect;
    isect.distance = (float)t;
    isect.position = glm::vec3(orig + t * dir);
    isect.fill = fill();
    isect.ray_direction = ray.direction;
    isect.normal = glm::vec3(glm::normalize(N));
    isect.front_face = true;
    if (glm::dot(isect.normal, ray.direction) > 0) {
        isect.normal = -isect.normal;
        isect.front_face = false;
    }
    return isect;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const
{
    Vec3d orig(ray.origin);
    Vec3d dir = glm::normalize(Vec3d(ray.direction));   // 1 to more digits than a float has
    Vec3d L = Vec3d(center_) - orig;
    double radius2 = (double)radius_ * radius_;
    double tca = glm::dot(L, dir);
    double d2 = glm::dot(L, L) - tca * tca;
    if (d2 > radius2) return std::nullopt;
    double thc = std::sqrt(radius2 - d2);
    double t0 = tca - thc;
    double t1 = tca + thc;

    if (t0 > t1) std::swap(t0, t1);
    if (t0 < 1e-5) {
        t0 = t1;
        if (t0 < 1e-5) return std::nullopt;
    }

    HitRecord isect;
    isect.distance = (float)t0;
    Vec3d P = orig + t0 * dir;
    isect.position = glm::vec3(P);
    isect.fill = fill();
    isect.ray_direction = ray.direction;
    isect.normal = glm::vec3(glm::normalize(P - Vec3d(center_)));
    isect.front_face = true;
    if (glm::dot(isect.normal, ray.direction) >= 0) {
        isect.normal = -isect.normal;
        isect.front_face = false;
    }
    return isect;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray)
{
    std::vector<HitRecord> hits;
    for (std::size_t k = 0; k < surfaces.size(); k++) {
        std::optional<HitRecord> isect = surfaces[k]->hit(ray);
        if (isect) hits.push_back(*isect);
    }
    if (hits.empty()) return std::nullopt;
    return *std::min_element(hits.begin(), hits.end(),
                             [](const HitRecord& l, const HitRecord& r) { return l.distance < r.distance; });
}

}
