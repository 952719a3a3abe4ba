#pragma once
// A triangle of a mesh: flat in shape, with what the mesh says about its corners, for step 11 to make use of.
#include <memory>

#include "core/mesh_face.hpp"
#include "core/texture.hpp"
#include "core/triangle.hpp"

namespace raysteps {

/// A picture, and what lies beyond its border. Many triangles share one.
struct MeshTexture {
    Texture image;
    Wrap wrap = Wrap::repeat;
};

class MeshTriangle final : public Triangle {
public:
    /// The texture's colours are multiplied by the fill's; there may be none.
    MeshTriangle(const MeshFace& face, const Fill& fill, std::shared_ptr<const MeshTexture> texture);

    /// The flat triangle's hit, marked as one that step 11 goes on with.
    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;
    [[nodiscard]] Shape shape() const override { return this; }

    [[nodiscard]] const MeshFace& face() const { return face_; }
    [[nodiscard]] const MeshTexture* texture() const { return texture_.get(); }

private:
    MeshFace face_;
    std::shared_ptr<const MeshTexture> texture_;
};

}  // namespace raysteps
