#pragma once
// A sphere that is seen from outside and from inside.
#include "core/surface.hpp"

namespace raysteps {

class Sphere : public Surface {
public:
    /// radius > 0
    Sphere(const glm::vec3& center, float radius, const Fill& fill);
    ~Sphere() override;

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;  ///< step 02
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] bool overlaps(const Box& box) const override;  ///< step 06
    [[nodiscard]] Shape shape() const override { return this; }

    [[nodiscard]] const glm::vec3& center() const { return center_; }
    [[nodiscard]] float radius() const { return radius_; }

private:
    glm::vec3 center_;
    float radius_;
};

}  // namespace raysteps
