#include "core/sphere.hpp"

namespace raysteps {

Sphere::Sphere(const glm::vec3& center, float radius, const Fill& fill)
    : Surface(fill), center_(center), radius_(radius) {}

// Here, and not in the header, so that the class's tables belong to the framework and not to a step.
Sphere::~Sphere() = default;

Box Sphere::bounds() const { return {center_ - glm::vec3(radius_), center_ + glm::vec3(radius_)}; }

}  // namespace raysteps
