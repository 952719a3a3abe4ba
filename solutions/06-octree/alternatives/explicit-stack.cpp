// The search keeps a heap of boxes instead of calling itself: always the one that the ray enters first, until the next
// one begins behind the closest hit. Whether there is any hit is asked with a plain stack, in no order. Both lists are
// kept from search to search, one for each thread, so that nothing is allocated. Clipping is done in double precision,
// and the tree splits until four surfaces are left, four levels below the root at most.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <vector>

namespace raysteps {
namespace {

constexpr std::size_t k_leaf_size = 4;
constexpr int k_levels = 4;

struct Waiting {
    float enter;
    const Node* node;
};

struct LaterFirst {
    bool operator()(const Waiting& a, const Waiting& b) const { return a.enter > b.enter; }
};

using Corners = std::array<glm::dvec3, 3>;

/// Separating axes: whether the shadows of triangle and box on the axis leave a gap.
bool gap_along(const glm::dvec3& axis, const Corners& corners, const glm::dvec3& half) {
    double low = glm::dot(axis, corners[0]);
    double high = low;
    for (std::size_t i = 1; i < 3; ++i) {
        const double at = glm::dot(axis, corners[i]);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    const double reach = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
    return low > reach || high < -reach;
}

Node grow(const Box& box, const SurfaceList& candidates, int level, float slack) {
    const Box reach = box.padded(slack);
    SurfaceList mine;
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(mine),
                 [&reach](const Surface* surface) { return surface->overlaps(reach); });
    if (mine.size() <= k_leaf_size || level == k_levels) {
        return {reach, mine, {}};
    }
    Node node{reach, {}, {}};
    std::size_t all_entries = 0;
    for (const Box& part : split(box)) {
        node.children.push_back(grow(part, mine, level + 1, slack));
        all_entries += node.children.back().surfaces.size();
    }
    const bool pointless = all_entries == 8 * mine.size();  // every part has every surface
    return pointless ? Node{reach, mine, {}} : node;
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    glm::vec3 low(k_infinity);
    glm::vec3 high(-k_infinity);
    for (const Surface* surface : surfaces) {
        const auto [own_low, own_high] = surface->bounds();
        low = glm::min(low, own_low);
        high = glm::max(high, own_high);
    }
    return Box{low, high};
}

std::array<Box, 8> split(const Box& box) {
    const glm::dvec3 middle = (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
    const glm::vec3 m(middle);
    const glm::vec3& a = box.min;
    const glm::vec3& b = box.max;
    return {Box{{a.x, a.y, a.z}, {m.x, m.y, m.z}}, Box{{m.x, a.y, a.z}, {b.x, m.y, m.z}},
            Box{{a.x, m.y, a.z}, {m.x, b.y, m.z}}, Box{{m.x, m.y, a.z}, {b.x, b.y, m.z}},
            Box{{a.x, a.y, m.z}, {m.x, m.y, b.z}}, Box{{m.x, a.y, m.z}, {b.x, m.y, b.z}},
            Box{{a.x, m.y, m.z}, {m.x, b.y, b.z}}, Box{{m.x, m.y, m.z}, {b.x, b.y, b.z}}};
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double direction = ray.direction[axis];
        const double to_low = static_cast<double>(min[axis]) - static_cast<double>(ray.origin[axis]);
        const double to_high = static_cast<double>(max[axis]) - static_cast<double>(ray.origin[axis]);
        if (direction == 0.0) {
            if (to_low > 0.0 || to_high < 0.0) {
                return std::nullopt;
            }
        } else {
            enter = std::max(enter, std::min(to_low / direction, to_high / direction));
            leave = std::min(leave, std::max(to_low / direction, to_high / direction));
        }
    }
    if (enter > leave) {
        return std::nullopt;
    }
    return Interval{static_cast<float>(enter), static_cast<float>(leave)};
}

bool Sphere::overlaps(const Box& box) const {
    const glm::dvec3 nearest = glm::clamp(glm::dvec3(center_), glm::dvec3(box.min), glm::dvec3(box.max));
    const double gap = glm::distance(nearest, glm::dvec3(center_));
    return gap <= 1.000001 * static_cast<double>(radius_);
}

bool Triangle::overlaps(const Box& box) const {
    const glm::dvec3 middle = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
    const glm::dvec3 half = 0.5 * (glm::dvec3(box.max) - glm::dvec3(box.min)) + 1e-6 * glm::abs(middle);
    const Corners corners{glm::dvec3(a_) - middle, glm::dvec3(b_) - middle, glm::dvec3(c_) - middle};
    const std::array<glm::dvec3, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    bool gap = gap_along(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), corners, half);
    for (std::size_t i = 0; i < 3; ++i) {
        gap = gap || gap_along(axes[i], corners, half);
        for (std::size_t j = 0; j < 3; ++j) {
            gap = gap || gap_along(glm::cross(axes[i], corners[(j + 1) % 3] - corners[j]), corners, half);
        }
    }
    return !gap;
}

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) {
        return {};
    }
    const Box all = bounds_of(surfaces);
    const glm::vec3 farthest = glm::max(glm::abs(all.min), glm::abs(all.max));
    return grow(all, surfaces, 0, 4e-6F * (farthest.x + farthest.y + farthest.z));
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    thread_local std::vector<Waiting> boxes;
    boxes.clear();
    if (const std::optional<Interval> part = root.box.hit(ray)) {
        boxes.push_back({part->enter, &root});
    }
    std::optional<HitRecord> closest;
    std::size_t order = 0;  // of the surface that was hit
    while (!boxes.empty()) {
        std::pop_heap(boxes.begin(), boxes.end(), LaterFirst());
        const Waiting next = boxes.back();
        boxes.pop_back();
        if (closest && closest->distance < next.enter - 1e-4F * (1.0F + next.enter)) {
            break;
        }
        for (const Surface* surface : next.node->surfaces) {
            const std::optional<HitRecord> hit = surface->hit(ray);
            const bool nearer = hit && (!closest || hit->distance < closest->distance);
            if (nearer || (hit && hit->distance == closest->distance && surface->order() < order)) {
                closest = hit;
                order = surface->order();
            }
        }
        for (const Node& child : next.node->children) {
            if (const std::optional<Interval> part = child.box.hit(ray)) {
                boxes.push_back({part->enter, &child});
                std::push_heap(boxes.begin(), boxes.end(), LaterFirst());
            }
        }
    }
    return closest;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    thread_local std::vector<const Node*> boxes;
    boxes.assign(1, &root);
    while (!boxes.empty()) {
        const Node& next = *boxes.back();
        boxes.pop_back();
        const std::optional<Interval> part = next.box.hit(ray);
        if (!part || distance < part->enter - 1e-4F * (1.0F + part->enter)) {
            continue;
        }
        for (const Surface* surface : next.surfaces) {
            const std::optional<HitRecord> hit = surface->hit(ray);
            if (hit && hit->distance < distance) {
                return true;
            }
        }
        for (const Node& child : next.children) {
            boxes.push_back(&child);
        }
    }
    return false;
}

}  // namespace raysteps
