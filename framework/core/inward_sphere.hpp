#pragma once
// A sphere of which only the inside is visible: NFF's negative radius.
#include "core/surface.hpp"

namespace raysteps {

/// Its own normal points to the centre, so every hit is one front_face. A ray from outside passes the near wall
/// and meets the far one.
class InwardSphere final : public Surface {
public:
    /// radius > 0
    InwardSphere(const glm::vec3& center, float radius, const Fill& fill);

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] bool overlaps(const Box& box) const override;
    [[nodiscard]] Shape shape() const override { return this; }

    [[nodiscard]] const glm::vec3& center() const { return center_; }
    [[nodiscard]] float radius() const { return radius_; }

private:
    glm::vec3 center_;
    float radius_;
};

/// A students' kit has none: rays meet them much as they meet the spheres of steps 02 and 06.
[[nodiscard]] bool has_inward_spheres();

}  // namespace raysteps
