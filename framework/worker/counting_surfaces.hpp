#pragma once
// Surfaces of the worker's own: they count for themselves how often they were asked.
#include "core/scene.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "worker/protocol.hpp"

namespace raysteps {

/// How often the surfaces of one case were asked.
struct TestCounter {
    long long times = 0;
};

class CountingSphere final : public Sphere {
public:
    CountingSphere(const glm::vec3& center, float radius, const Fill& fill, TestCounter& asked)
        : Sphere(center, radius, fill), asked_(asked) {}

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override {
        ++asked_.times;
        return Sphere::intersect(ray);
    }

private:
    TestCounter& asked_;
};

class CountingTriangle final : public Triangle {
public:
    CountingTriangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const Fill& fill, TestCounter& asked)
        : Triangle(a, b, c, fill), asked_(asked) {}

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override {
        ++asked_.times;
        return Triangle::intersect(ray);
    }

private:
    TestCounter& asked_;
};

/// Is hit by every ray at one distance, or by none: a search can be judged without anybody's intersection.
class ScriptedSurface final : public Surface {
public:
    ScriptedSurface(std::optional<float> distance, const Fill& fill, TestCounter& asked)
        : Surface(fill), distance_(distance), asked_(asked) {}

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;
    [[nodiscard]] Box bounds() const override { return {glm::vec3(-1e6F), glm::vec3(1e6F)}; }
    [[nodiscard]] bool overlaps(const Box& /*box*/) const override { return true; }

private:
    std::optional<float> distance_;
    TestCounter& asked_;
};

/// What follows the number of each: centre and radius, three corners, a distance, or nothing for what no ray hits.
enum class SurfaceKind { sphere, triangle, distance, none, glass_sphere };

/// How many, then each: its SurfaceKind, and what that takes. Surface i has red (i + 1) / 256, by which an answer is
/// known.
[[nodiscard]] Scene read_surfaces(TokenReader& words, TestCounter& asked);

}  // namespace raysteps
