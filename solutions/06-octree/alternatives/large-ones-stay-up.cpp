// A surface moves down the tree only while it touches few of the eight parts; what is large beside them stays in the
// list of the box above. Triangles are sorted in by their bounds only, and the search takes the children in the order
// that the signs of the ray's direction give.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

namespace raysteps {
namespace {

constexpr std::size_t k_short_list = 6;
constexpr int k_max_levels = 7;
constexpr std::size_t k_max_parts = 4;
constexpr float k_share = 1e-5F;  // of the numbers, by which boxes are held to be larger than they are

float size_of_numbers(const Box& box) { return glm::length(box.min) + glm::length(box.max); }

Node sort_in(const Box& box, SurfaceList surfaces, int level, float margin) {
    Node node{box.padded(margin), {}, {}};
    if (level == k_max_levels || surfaces.size() <= k_short_list) {
        node.surfaces = std::move(surfaces);
        return node;
    }
    const std::array<Box, 8> parts = split(box);
    std::array<SurfaceList, 8> lists;
    for (const Surface* surface : surfaces) {
        std::vector<std::size_t> touched;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (surface->overlaps(parts[i].padded(margin))) {
                touched.push_back(i);
            }
        }
        if (touched.size() > k_max_parts) {
            node.surfaces.push_back(surface);
        } else {
            for (const std::size_t i : touched) {
                lists[i].push_back(surface);
            }
        }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        node.children.push_back(sort_in(parts[i], std::move(lists[i]), level + 1, margin));
    }
    return node;
}

struct Found {
    HitRecord hit;
    std::size_t order;

    [[nodiscard]] bool comes_before(const Found& other) const {
        return std::tie(hit.distance, order) < std::tie(other.hit.distance, other.order);
    }
};

void search(const Node& node, const Ray& ray, std::optional<Found>& closest) {
    const std::optional<Interval> part = node.box.hit(ray);
    if (!part || (closest && closest->hit.distance < part->enter * (1.0F - 10.0F * k_share))) {
        return;
    }
    for (const Surface* surface : node.surfaces) {
        if (const std::optional<HitRecord> hit = surface->hit(ray)) {
            const Found found{*hit, surface->order()};
            if (!closest || found.comes_before(*closest)) {
                closest = found;
            }
        }
    }
    // Bit by bit: where the ray runs downwards along an axis, the upper part comes first.
    std::size_t flip = 0;
    for (int axis = 0; axis < 3; ++axis) {
        flip |= ray.direction[axis] < 0.0F ? std::size_t{1} << axis : std::size_t{0};
    }
    const bool eight = node.children.size() == 8;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
        search(node.children[eight ? i ^ flip : i], ray, closest);
    }
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box box;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const Box other = surfaces[i]->bounds();
        box = i == 0 ? other : Box{glm::min(box.min, other.min), glm::max(box.max, other.max)};
    }
    return box;
}

std::array<Box, 8> split(const Box& box) {
    std::array<Box, 8> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const float half = box.min[axis] + (box.max[axis] - box.min[axis]) / 2.0F;
            const bool upper = (i & (std::size_t{1} << axis)) != 0;
            parts[i].min[axis] = upper ? half : box.min[axis];
            parts[i].max[axis] = upper ? box.max[axis] : half;
        }
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    // All six distances at once; fmin and fmax pass over the NaN of 0 / 0, which is a ray within a face.
    const glm::vec3 to_min = (min - ray.origin) / ray.direction;
    const glm::vec3 to_max = (max - ray.origin) / ray.direction;
    Interval part;
    for (int axis = 0; axis < 3; ++axis) {
        const bool along_a_face = std::isnan(to_min[axis]) || std::isnan(to_max[axis]);
        if (!along_a_face) {
            part.enter = std::fmax(part.enter, std::fmin(to_min[axis], to_max[axis]));
            part.leave = std::fmin(part.leave, std::fmax(to_min[axis], to_max[axis]));
        }
    }
    return part.leave >= part.enter ? std::make_optional(part) : std::nullopt;
}

bool Sphere::overlaps(const Box& box) const {
    const glm::vec3 inside = glm::max(box.min, glm::min(center_, box.max));
    const glm::vec3 gap = inside - center_;
    const float reach = radius_ * (1.0F + k_share);
    return glm::dot(gap, gap) <= reach * reach;
}

bool Triangle::overlaps(const Box& box) const {
    const Box own = bounds().padded(k_share * size_of_numbers(bounds()));
    const glm::bvec3 below = glm::lessThanEqual(own.min, box.max);
    const glm::bvec3 above = glm::lessThanEqual(box.min, own.max);
    return below.x && below.y && below.z && above.x && above.y && above.z;
}

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) {
        return Node{};
    }
    const Box all = bounds_of(surfaces);
    return sort_in(all, surfaces, 0, k_share * size_of_numbers(all));
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<Found> closest;
    search(root, ray, closest);
    return closest ? std::make_optional(closest->hit) : std::nullopt;
}

// The children first: what is large stays up here, and is more often far away than in between.
bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    const std::optional<Interval> part = root.box.hit(ray);
    if (!part || part->enter * (1.0F - 10.0F * k_share) > distance) {
        return false;
    }
    for (const Node& child : root.children) {
        if (occluded_in_octree(child, ray, distance)) {
            return true;
        }
    }
    for (const Surface* surface : root.surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit.has_value() && hit->distance < distance) {
            return true;
        }
    }
    return false;
}

}  // namespace raysteps
