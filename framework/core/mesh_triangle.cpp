#include "core/mesh_triangle.hpp"

#include <utility>

namespace raysteps {

MeshTriangle::MeshTriangle(const MeshFace& face, const Fill& fill, std::shared_ptr<const MeshTexture> texture)
    : Triangle(face.front().position, face.at(1).position, face.back().position, fill),
      face_(face),
      texture_(std::move(texture)) {}

std::optional<HitRecord> MeshTriangle::intersect(const Ray& ray) const {
    std::optional<HitRecord> hit = Triangle::intersect(ray);
    if (hit) {
        hit->mesh_triangle = static_cast<std::uint32_t>(order() + 1);
    }
    return hit;
}

}  // namespace raysteps
