#pragma once
// A flat triangle, seen from both sides.
#include "core/surface.hpp"

namespace raysteps {

class Triangle : public Surface {
public:
    /// Corners counter-clockwise as seen from the front.
    Triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const Fill& fill);
    ~Triangle() override;

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;  ///< step 02
    [[nodiscard]] Box bounds() const override;
    [[nodiscard]] bool overlaps(const Box& box) const override;  ///< step 06
    [[nodiscard]] Shape shape() const override { return this; }

    [[nodiscard]] const glm::vec3& a() const { return a_; }
    [[nodiscard]] const glm::vec3& b() const { return b_; }
    [[nodiscard]] const glm::vec3& c() const { return c_; }

private:
    glm::vec3 a_;
    glm::vec3 b_;
    glm::vec3 c_;
};

}  // namespace raysteps
