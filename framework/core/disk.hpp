#pragma once
// A flat round plate, seen from both sides.
#include "core/surface.hpp"

namespace raysteps {

class Disk final : public Surface {
public:
    /// The normal, of unit length, points to the front; radius > 0.
    Disk(const glm::vec3& center, const glm::vec3& normal, float radius, const Fill& fill);

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] bool overlaps(const Box& box) const override;
    [[nodiscard]] Shape shape() const override { return this; }

    [[nodiscard]] const glm::vec3& center() const { return center_; }
    [[nodiscard]] const glm::vec3& normal() const { return normal_; }
    [[nodiscard]] float radius() const { return radius_; }

private:
    glm::vec3 center_;
    glm::vec3 normal_;
    float radius_;
};

}  // namespace raysteps
