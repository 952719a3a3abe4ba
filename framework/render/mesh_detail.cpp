#include "render/mesh_detail.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <unordered_map>
#include <utility>
#include <variant>

#include "core/mesh_triangle.hpp"
#include "render/integrator.hpp"
#include "steps/11-meshes/meshes.hpp"

namespace raysteps {
namespace {

constexpr int k_first_step = 11;

const MeshTriangle* mesh_triangle_of(const Surface& surface) {
    const Shape shape = surface.shape();
    const auto* found = std::get_if<const MeshTriangle*>(&shape);
    return found == nullptr ? nullptr : *found;
}

/// With its normals on the side that the ray came from.
MeshFace face_towards(const MeshTriangle& triangle, const HitRecord& hit) {
    MeshFace face = triangle.face();
    for (MeshCorner& corner : face) {
        if (glm::dot(corner.normal, hit.normal) < 0.0F) {
            corner.normal = -corner.normal;
        }
    }
    return face;
}

class MeshDetails final : public Accelerator {
public:
    MeshDetails(std::unique_ptr<Accelerator> inner, const Scene& scene) : inner_(std::move(inner)), scene_(scene) {
        for (const Surface* surface : scene.surfaces()) {
            const MeshTriangle* triangle = mesh_triangle_of(*surface);
            if (triangle != nullptr && triangle->texture() != nullptr && !pyramids_.contains(triangle->texture())) {
                pyramids_[triangle->texture()] = build_pyramid(triangle->texture()->image);
            }
        }
    }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        std::optional<HitRecord> hit = inner_->closest_hit(ray);
        // The mark may have been through a student's hands.
        if (hit && hit->mesh_triangle > 0 && hit->mesh_triangle <= scene_.surfaces().size()) {
            if (const MeshTriangle* triangle = mesh_triangle_of(*scene_.surfaces()[hit->mesh_triangle - 1])) {
                add_details(*triangle, *hit);
            }
        }
        return hit;
    }
    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return inner_->occluded(ray, distance);
    }
    [[nodiscard]] bool occluded_with_hint(const Ray& ray, float distance, OccluderHint& hint) const override {
        return inner_->occluded_with_hint(ray, distance, hint);
    }
    [[nodiscard]] AcceleratorStats size() const override { return inner_->size(); }
    void visit_nodes(const Surface* wanted, const NodeVisitor& visit) const override {
        inner_->visit_nodes(wanted, visit);
    }

private:
    void add_details(const MeshTriangle& triangle, HitRecord& hit) const {
        const HitRecord flat = hit;
        const MeshFace face = face_towards(triangle, flat);
        const glm::vec3 weights = barycentric(face, flat.position);
        hit.normal = shading_normal(face, weights, flat);
        hit.position = curved_position(face, weights, flat.position);
        if (triangle.texture() != nullptr) {
            hit.fill.color *= color_at(face, weights, flat, *triangle.texture());
        }
    }

    [[nodiscard]] Color color_at(const MeshFace& face, const glm::vec3& weights, const HitRecord& flat,
                                 const MeshTexture& texture) const {
        const Pyramid& pyramid = pyramids_.at(&texture);
        if (pyramid.empty()) {
            return k_white;
        }
        const glm::vec2 size(texture.image.width, texture.image.height);
        const float pixel_angle =
            2.0F * glm::tan(glm::radians(scene_.camera.angle) / 2.0F) / static_cast<float>(scene_.camera.height);
        const float texels = texels_across(face, size, flat, pixel_angle);
        const float level = mip_level(texels, static_cast<int>(pyramid.size()));
        const auto last = static_cast<float>(pyramid.size() - 1);
        return trilinear(pyramid, texture_coordinates(face, weights),
                         std::isfinite(level) ? std::clamp(level, 0.0F, last) : 0.0F, texture.wrap);
    }

    std::unique_ptr<Accelerator> inner_;
    const Scene& scene_;
    std::unordered_map<const MeshTexture*, Pyramid> pyramids_;
};

}  // namespace

bool adds_mesh_details(int step) { return is_of_part_two(step) && step >= k_first_step; }

std::unique_ptr<Accelerator> with_mesh_details(std::unique_ptr<Accelerator> inner, const Scene& scene, int step) {
    const auto is_mesh = [](const Surface* surface) { return mesh_triangle_of(*surface) != nullptr; };
    if (!adds_mesh_details(step) || std::none_of(scene.surfaces().begin(), scene.surfaces().end(), is_mesh)) {
        return inner;
    }
    return std::make_unique<MeshDetails>(std::move(inner), scene);
}

}  // namespace raysteps
