#define NO_THREADED_BUILDS
#define TINYBVH_IMPLEMENTATION
#include <tiny_bvh.h>

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "bench/foreign_hit.hpp"
#include "bench/other_libraries.hpp"
#include "core/triangle.hpp"

namespace raysteps::bench {
namespace {

constexpr std::size_t k_block_bytes = 64;  // of BVH8_CPU's nodes and leaves

tinybvh::Ray tiny_ray(const Ray& ray, float far) {
    tinybvh::Ray made;
    made.O = {ray.origin.x, ray.origin.y, ray.origin.z};
    made.D = {ray.direction.x, ray.direction.y, ray.direction.z};
    made.rD = tinybvh::tinybvh_rcp(made.D);
    made.hit.t = far;
    return made;
}

class TinyBvhAccelerator final : public Accelerator {
public:
    explicit TinyBvhAccelerator(const SurfaceList& surfaces) : surfaces_(surfaces) {
        corners_.reserve(3 * surfaces.size());
        for (const Surface* surface : surfaces) {
            for (const glm::vec3& corner : corners_of(*surface)) {
                corners_.emplace_back(corner.x, corner.y, corner.z, 0.0F);
            }
        }
        bvh_.Build(corners_.data(), static_cast<std::uint32_t>(surfaces.size()));
    }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        tinybvh::Ray asked = tiny_ray(ray, BVH_FAR);
        bvh_.Intersect(asked);
        if (!(asked.hit.t < BVH_FAR)) {
            return std::nullopt;
        }
        const Surface& surface = *surfaces_[asked.hit.prim];
        const auto [a, b, c] = corners_of(surface);
        return foreign_hit(surface, ray, asked.hit.t, glm::cross(b - a, c - a), asked.hit.u, asked.hit.v);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return bvh_.IsOccluded(tiny_ray(ray, distance));
    }

    [[nodiscard]] AcceleratorStats size() const override {
        AcceleratorStats size;
        size.references = surfaces_.size();
        size.bytes = k_block_bytes * bvh_.usedBlocks;
        return size;
    }

private:
    static std::array<glm::vec3, 3> corners_of(const Surface& surface) {
        const auto& triangle = static_cast<const Triangle&>(surface);
        return {triangle.a(), triangle.b(), triangle.c()};
    }

    SurfaceList surfaces_;
    std::vector<tinybvh::bvhvec4> corners_;
    tinybvh::BVH8_CPU bvh_;
};

}  // namespace

std::unique_ptr<Accelerator> make_tinybvh(const SurfaceList& surfaces) {
    return std::make_unique<TinyBvhAccelerator>(surfaces);
}

}  // namespace raysteps::bench
