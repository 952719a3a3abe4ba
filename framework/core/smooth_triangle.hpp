#pragma once
// A triangle of an NFF patch (`pp`): flat in shape, its normal blended from the corners' normals.
#include "core/triangle.hpp"

namespace raysteps {

class SmoothTriangle final : public Triangle {
public:
    struct Corner {
        glm::vec3 position;
        glm::vec3 normal;  ///< unit length
    };

    SmoothTriangle(const Corner& a, const Corner& b, const Corner& c, const Fill& fill);

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;
    [[nodiscard]] Shape shape() const override { return this; }

    [[nodiscard]] const glm::vec3& normal_a() const { return normal_a_; }
    [[nodiscard]] const glm::vec3& normal_b() const { return normal_b_; }
    [[nodiscard]] const glm::vec3& normal_c() const { return normal_c_; }

private:
    glm::vec3 normal_a_;
    glm::vec3 normal_b_;
    glm::vec3 normal_c_;
};

}  // namespace raysteps
