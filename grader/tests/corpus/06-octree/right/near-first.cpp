#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <limits>
#include <utility>

namespace raysteps {

Box bounds_of(const SurfaceList& surfaces) {
    Box all;
    for (const auto* s : surfaces) all.extend(s->bounds());
    return all;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 half = (box.max - box.min) * 0.5F;
    const glm::vec3 mid = box.min + half;
    std::array<Box, 8> out;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::bvec3 up((i & 1U) != 0, (i & 2U) != 0, (i & 4U) != 0);
        out[i] = Box{glm::mix(box.min, mid, up), glm::mix(mid, box.max, up)};
    }
    return out;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval part;
    for (int i = 0; i < 3; ++i) {
        const bool forwards = ray.direction[i] > 0.0F;
        const float first = (forwards ? min[i] : max[i]) - ray.origin[i];
        const float second = (forwards ? max[i] : min[i]) - ray.origin[i];
        if (ray.direction[i] == 0.0F) {
            // first and second belong to max and min here: the origin has to be between them
            if (first < 0.0F || second > 0.0F) return {};
        } else {
            part.enter = std::max(part.enter, first / ray.direction[i]);
            part.leave = std::min(part.leave, second / ray.direction[i]);
        }
    }
    if (part.enter <= part.leave) return part;
    return {};
}

bool Sphere::overlaps(const Box& box) const {
    const glm::dvec3 nearest(glm::clamp(center(), box.min, box.max));
    const glm::dvec3 way = nearest - glm::dvec3(center());
    const double reach = radius() * (1.0 + 1e-6);  // a yes too many does no harm
    return glm::dot(way, way) <= reach * reach;
}

bool Triangle::overlaps(const Box& box) const {
    const Box own = bounds();
    return glm::all(glm::lessThanEqual(own.min, box.max)) && glm::all(glm::lessThanEqual(box.min, own.max));
}

namespace {

constexpr int k_deepest = 5;
constexpr std::size_t k_short = 6;

void divide(Node& node, int level) {
    if (level >= k_deepest || node.surfaces.size() <= k_short) return;
    for (const Box& part : split(node.box)) {
        Node child{part, {}, {}};
        std::copy_if(node.surfaces.begin(), node.surfaces.end(), std::back_inserter(child.surfaces),
                     [&](const Surface* s) { return s->overlaps(part); });
        if (child.surfaces.empty()) continue;
        divide(child, level + 1);
        node.children.push_back(std::move(child));
    }
    node.surfaces.clear();
}

struct Nearest {
    std::optional<HitRecord> hit;
    std::size_t order = 0;
    float distance = std::numeric_limits<float>::infinity();
};

// `node` has been entered already.
void look(const Node& node, const Ray& ray, Nearest& nearest) {
    for (const auto* s : node.surfaces) {
        if (auto h = s->hit(ray)) {
            if (h->distance < nearest.distance || (h->distance == nearest.distance && s->order() < nearest.order)) {
                nearest.distance = h->distance;
                nearest.order = s->order();
                nearest.hit = std::move(h);
            }
        }
    }
    std::vector<std::pair<float, const Node*>> entered;
    for (const Node& child : node.children)
        if (const auto part = child.box.hit(ray)) entered.emplace_back(part->enter, &child);
    std::sort(entered.begin(), entered.end());
    for (const auto& [enter, child] : entered) {
        if (enter > nearest.distance) break;  // all that follow begin behind the hit
        look(*child, ray, nearest);
    }
}

bool blocked(const Node& node, const Ray& ray, float distance) {
    const auto part = node.box.hit(ray);
    if (!part || part->enter > distance) return false;
    const auto blocks = [&](const Surface* s) {
        const auto h = s->hit(ray);
        return h && h->distance < distance;
    };
    return std::any_of(node.surfaces.begin(), node.surfaces.end(), blocks) ||
           std::any_of(node.children.begin(), node.children.end(),
                       [&](const Node& child) { return blocked(child, ray, distance); });
}

}  // namespace

Node build_octree(const SurfaceList& surfaces) {
    Node root{bounds_of(surfaces), surfaces, {}};
    divide(root, 1);
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    Nearest nearest;
    if (root.box.hit(ray)) look(root, ray, nearest);
    return nearest.hit;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) { return blocked(root, ray, distance); }

}  // namespace raysteps
