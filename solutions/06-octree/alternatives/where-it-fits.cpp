// Each surface goes down to the smallest box that holds all of it, and what lies across the cuts stays above them,
// where it is not too much (a MX-CIF tree). A part in which nothing is has no box. Slabs are clipped in double
// precision, and the search keeps a stack that is sorted by where the ray enters.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace raysteps {

namespace {

constexpr int k_max_levels = 6;
constexpr std::size_t k_short_list = 2;
constexpr std::size_t k_max_across = 6;  // of the cuts of a box
constexpr float k_slack = 2e-5F;

bool touch(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

Node sort_in(const Box& box, const SurfaceList& surfaces, int level) {
    Node node{.box = box, .surfaces = {}, .children = {}};
    const std::array<Box, 8> parts = split(box);
    std::array<SurfaceList, 8> lists;
    for (const Surface* surface : surfaces) {
        const auto holds = [&](const Box& part) { return part.contains(surface->bounds()); };
        const auto own = std::find_if(parts.begin(), parts.end(), holds);
        SurfaceList& list = own == parts.end() ? node.surfaces : lists[static_cast<std::size_t>(own - parts.begin())];
        list.push_back(surface);
    }
    const bool is_leaf = surfaces.size() <= k_short_list || level == k_max_levels;
    if (is_leaf || node.surfaces.size() == surfaces.size()) {
        node.surfaces = surfaces;
        return node;
    }
    if (node.surfaces.size() > k_max_across) {
        for (const Surface* surface : std::exchange(node.surfaces, {})) {
            for (std::size_t i = 0; i < parts.size(); ++i) {
                if (surface->overlaps(parts[i])) {
                    lists[i].push_back(surface);
                }
            }
        }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!lists[i].empty()) {
            node.children.push_back(sort_in(parts[i], lists[i], level + 1));
        }
    }
    return node;
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box box;
    for (const Surface* surface : surfaces) {
        box.extend(surface->bounds().min);
        box.extend(surface->bounds().max);
    }
    return box;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 middle = box.center();
    std::array<Box, 8> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_upper = (i >> static_cast<std::size_t>(axis) & 1U) == 1U;
            parts[i].min[axis] = is_upper ? middle[axis] : box.min[axis];
            parts[i].max[axis] = is_upper ? box.max[axis] : middle[axis];
        }
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = ray.origin[axis];
        const double way = ray.direction[axis];
        if (way == 0.0) {
            if (origin < min[axis] || origin > max[axis]) {
                return std::nullopt;
            }
            continue;
        }
        const auto [first, second] = std::minmax({(min[axis] - origin) / way, (max[axis] - origin) / way});
        enter = std::max(enter, first);
        leave = std::min(leave, second);
    }
    if (enter > leave) {
        return std::nullopt;
    }
    return Interval{.enter = static_cast<float>(enter), .leave = static_cast<float>(leave)};
}

bool Sphere::overlaps(const Box& box) const {
    return glm::distance(center_, glm::clamp(center_, box.min, box.max)) <= radius_ * (1.0F + k_slack);
}

bool Triangle::overlaps(const Box& box) const { return touch(bounds(), box); }

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) {
        return {};
    }
    const Box box = bounds_of(surfaces);
    const float margin = 1e-5F * (glm::length(box.max - box.min) + glm::length(box.min) + glm::length(box.max));
    return sort_in(box.padded(margin), surfaces, 0);
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<HitRecord> closest;
    std::size_t order = 0;
    std::vector<std::pair<float, const Node*>> open;
    if (const std::optional<Interval> part = root.box.hit(ray)) {
        open.emplace_back(part->enter, &root);
    }
    while (!open.empty()) {
        const auto [enter, node] = open.back();
        open.pop_back();
        if (closest && enter > closest->distance * (1.0F + k_slack)) {
            continue;
        }
        for (const Surface* surface : node->surfaces) {
            const std::optional<HitRecord> hit = surface->hit(ray);
            if (hit && (!closest || std::pair(hit->distance, surface->order()) < std::pair(closest->distance, order))) {
                closest = hit;
                order = surface->order();
            }
        }
        const auto first = static_cast<std::ptrdiff_t>(open.size());
        for (const Node& child : node->children) {
            if (const std::optional<Interval> part = child.box.hit(ray)) {
                open.emplace_back(part->enter, &child);
            }
        }
        std::sort(open.begin() + first, open.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    }
    return closest;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    std::vector<const Node*> open{&root};
    while (!open.empty()) {
        const Node* const node = open.back();
        open.pop_back();
        const std::optional<Interval> part = node->box.hit(ray);
        if (!part || part->enter > distance) {
            continue;
        }
        for (const Surface* surface : node->surfaces) {
            const std::optional<HitRecord> hit = surface->hit(ray);
            if (hit && hit->distance < distance) {
                return true;
            }
        }
        for (const Node& child : node->children) {
            open.push_back(&child);
        }
    }
    return false;
}

}  // namespace raysteps
