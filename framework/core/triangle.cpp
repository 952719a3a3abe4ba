#include "core/triangle.hpp"

#include <glm/common.hpp>

namespace raysteps {

Triangle::Triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const Fill& fill)
    : Surface(fill), a_(a), b_(b), c_(c) {}

// Here, and not in the header, so that the class's tables belong to the framework and not to a step.
Triangle::~Triangle() = default;

Box Triangle::bounds() const { return {glm::min(a_, glm::min(b_, c_)), glm::max(a_, glm::max(b_, c_))}; }

}  // namespace raysteps
