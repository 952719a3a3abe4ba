#pragma once
// A cone, a cut cone or a cylinder, open at both ends: NFF's `c`.
#include <glm/vec3.hpp>

#include "core/surface.hpp"

namespace raysteps {

/// Its own normal points away from the axis, or towards it where only the inside is visible.
class Cone final : public Surface {
public:
    /// One end of the cone.
    struct End {
        glm::vec3 center{0.0F};
        float radius = 0.0F;
    };

    /// `inside`: a wall that the ray would meet from outside is not there (NFF's negative radii).
    enum class Sidedness { both, inside };

    /// The centres differ; both radii are >= 0, one at least above 0.
    Cone(const End& base, const End& apex, Sidedness sidedness, const Fill& fill);

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] bool overlaps(const Box& box) const override;
    [[nodiscard]] Shape shape() const override { return this; }

    [[nodiscard]] const End& base() const { return base_; }
    [[nodiscard]] const End& apex() const { return apex_; }
    [[nodiscard]] Sidedness sidedness() const { return sidedness_; }

private:
    [[nodiscard]] std::optional<HitRecord> wall_hit(const Ray& ray, double distance) const;

    End base_;
    End apex_;
    Sidedness sidedness_;
    glm::dvec3 axis_;  // unit length, from base to apex
    double length_;
    double slope_;  // growth of the radius per unit along the axis
};

}  // namespace raysteps
