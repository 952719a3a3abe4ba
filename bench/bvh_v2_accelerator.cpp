#include <bvh/v2/bvh.h>
#include <bvh/v2/default_builder.h>
#include <bvh/v2/node.h>
#include <bvh/v2/stack.h>
#include <bvh/v2/tri.h>

#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include "bench/foreign_hit.hpp"
#include "bench/other_libraries.hpp"
#include "core/triangle.hpp"

namespace raysteps::bench {
namespace {

namespace v2 = bvh::v2;
using Vec3 = v2::Vec<float, 3>;
using Node = v2::Node<float, 3>;
using Bvh = v2::Bvh<Node>;
using V2Ray = v2::Ray<float, 3>;

constexpr std::size_t k_stack = 128;

Vec3 vec(const glm::vec3& from) { return {from.x, from.y, from.z}; }

/// A surface in the order of the leaves.
struct Candidate {
    const Surface* surface = nullptr;
    bool is_triangle = false;
    v2::PrecomputedTri<float> triangle;
};

Candidate candidate_of(const Surface& surface) {
    Candidate made{&surface, false, {}};
    if (const auto* const triangle = dynamic_cast<const Triangle*>(&surface)) {
        made.is_triangle = true;
        made.triangle = {vec(triangle->a()), vec(triangle->b()), vec(triangle->c())};
    }
    return made;
}

class BvhV2Accelerator final : public Accelerator {
public:
    explicit BvhV2Accelerator(const SurfaceList& surfaces) {
        std::vector<v2::BBox<float, 3>> boxes;
        std::vector<Vec3> centers;
        for (const Surface* surface : surfaces) {
            const Box box = surface->bounds();
            boxes.emplace_back(vec(box.min), vec(box.max));
            centers.push_back(vec(0.5F * (box.min + box.max)));
        }
        v2::DefaultBuilder<Node>::Config config;
        config.quality = v2::DefaultBuilder<Node>::Quality::High;
        bvh_ = v2::DefaultBuilder<Node>::build(boxes, centers, config);
        candidates_.reserve(surfaces.size());
        for (const std::size_t place : bvh_.prim_ids) {
            candidates_.push_back(candidate_of(*surfaces[place]));
        }
    }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        V2Ray asked = v2_ray(ray, std::numeric_limits<float>::max());
        std::optional<HitRecord> other;  // of what is no triangle
        const Candidate* nearest = nullptr;
        float u = 0.0F;
        float v = 0.0F;
        search<false>(asked, [&](const Candidate& candidate) {
            if (!candidate.is_triangle) {
                const auto hit = candidate.surface->hit(ray);
                if (!hit || !(hit->distance < asked.tmax)) {
                    return false;
                }
                asked.tmax = hit->distance;
                other = hit;
            } else if (const auto hit = candidate.triangle.intersect(asked)) {
                std::tie(asked.tmax, u, v) = *hit;
            } else {
                return false;
            }
            nearest = &candidate;
            return true;
        });
        if (nearest == nullptr) {
            return std::nullopt;
        }
        const Vec3& normal = nearest->triangle.n;
        return nearest->is_triangle
                   ? foreign_hit(*nearest->surface, ray, asked.tmax, -glm::vec3(normal[0], normal[1], normal[2]), u, v)
                   : other;
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        V2Ray asked = v2_ray(ray, distance);
        bool found = false;
        search<true>(asked, [&](const Candidate& candidate) {
            if (candidate.is_triangle) {
                found = candidate.triangle.intersect(asked).has_value();
            } else {
                const auto hit = candidate.surface->hit(ray);
                found = hit && hit->distance < distance;
            }
            return found;
        });
        return found;
    }

    [[nodiscard]] AcceleratorStats size() const override {
        AcceleratorStats size;
        size.boxes = bvh_.nodes.size();
        size.references = candidates_.size();
        size.bytes = bvh_.nodes.size() * sizeof(Node) + candidates_.size() * sizeof(Candidate);
        return size;
    }

private:
    static V2Ray v2_ray(const Ray& ray, float far) { return {vec(ray.origin), vec(ray.direction), 0.0F, far}; }

    /// `is_hit` is asked of the surfaces of each leaf that the ray meets.
    template <bool any, typename IsHit>
    void search(V2Ray& ray, const IsHit& is_hit) const {
        v2::SmallStack<Bvh::Index, k_stack> stack;
        bvh_.template intersect<any, false>(ray, bvh_.get_root().index, stack, [&](std::size_t begin, std::size_t end) {
            bool hit = false;
            for (std::size_t place = begin; place < end && !(any && hit); ++place) {
                hit = is_hit(candidates_[place]) || hit;
            }
            return hit;
        });
    }

    Bvh bvh_;
    std::vector<Candidate> candidates_;
};

}  // namespace

std::unique_ptr<Accelerator> make_bvh_v2(const SurfaceList& surfaces) {
    return std::make_unique<BvhV2Accelerator>(surfaces);
}

}  // namespace raysteps::bench
