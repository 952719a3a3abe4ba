// Up to five levels, triangles by separating axes, boxes sorted by where the ray enters them.
#include "steps/06-octree/octree.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace raysteps {

namespace {

constexpr std::size_t k_short_list = 4;
constexpr int k_deepest = 4;

void divide(Node& node, SurfaceList list, int level, float padding) {
    if (list.size() <= k_short_list || level >= k_deepest) {
        node.surfaces = std::move(list);
        return;
    }
    const std::array<Box, 8> parts = split(node.box);
    std::array<Box, 8> boxes;
    std::array<SurfaceList, 8> lists;
    std::size_t entries = 0;
    bool shorter = false;
    for (std::size_t i = 0; i < 8; ++i) {
        // a little larger, but not out of the box above
        const Box padded = parts[i].padded(padding);
        boxes[i] = Box{glm::max(padded.min, node.box.min), glm::min(padded.max, node.box.max)};
        std::copy_if(list.begin(), list.end(), std::back_inserter(lists[i]),
                     [&](const Surface* surface) { return surface->overlaps(boxes[i]); });
        entries += lists[i].size();
        shorter = shorter || lists[i].size() < list.size();
    }
    if (!shorter || (level >= 2 && entries >= 2 * list.size())) {
        node.surfaces = std::move(list);
        return;
    }
    for (std::size_t i = 0; i < 8; ++i) {
        if (!lists[i].empty()) {
            Node& child = node.children.emplace_back();
            child.box = boxes[i];
            divide(child, std::move(lists[i]), level + 1, padding);
        }
    }
}

class Search {
public:
    explicit Search(const Ray& ray) : ray_(ray) {}

    void visit(const Node& node) {
        for (const Surface* surface : node.surfaces) {
            ask(*surface);
        }
        std::array<std::pair<float, const Node*>, 8> entered;
        std::size_t count = 0;
        for (const Node& child : node.children) {
            if (const auto part = child.box.hit(ray_); part && count < entered.size()) {
                entered[count++] = {part->enter, &child};
            }
        }
        std::sort(entered.begin(), entered.begin() + static_cast<std::ptrdiff_t>(count));
        for (std::size_t i = 0; i < count; ++i) {
            if (entered[i].first > limit_) {
                break;
            }
            visit(*entered[i].second);
        }
    }

    [[nodiscard]] const std::optional<HitRecord>& best() const { return best_; }

private:
    void ask(const Surface& surface) {
        const std::optional<HitRecord> hit = surface.hit(ray_);
        if (!hit) {
            return;
        }
        const bool nearer = !best_ || hit->distance < best_->distance;
        if (nearer || (hit->distance == best_->distance && surface.order() < order_)) {
            best_ = hit;
            order_ = surface.order();
            limit_ = hit->distance * (1.0F + k_distance_slack);
        }
    }

    const Ray& ray_;
    std::optional<HitRecord> best_;
    std::size_t order_ = 0;
    float limit_ = std::numeric_limits<float>::infinity();
};

// Do the shadows of triangle and box on the axis lie apart? All relative to the box's centre.
bool apart(const std::array<glm::dvec3, 3>& corner, const glm::dvec3& half, const glm::dvec3& axis) {
    const double p0 = glm::dot(corner[0], axis);
    const double p1 = glm::dot(corner[1], axis);
    const double p2 = glm::dot(corner[2], axis);
    const double reach = glm::dot(half, glm::abs(axis)) * (1.0 + 1e-9) + 1e-12;
    return std::min({p0, p1, p2}) > reach || std::max({p0, p1, p2}) < -reach;
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box box;
    for (const Surface* surface : surfaces) {
        box.extend(surface->bounds());
    }
    return box;
}

std::array<Box, 8> split(const Box& box) {
    const std::array<glm::vec3, 3> cuts{box.min, box.center(), box.max};
    std::array<Box, 8> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t x = i & 1U;
        const std::size_t y = (i >> 1U) & 1U;
        const std::size_t z = (i >> 2U) & 1U;
        parts[i] = Box{{cuts[x].x, cuts[y].y, cuts[z].z}, {cuts[x + 1].x, cuts[y + 1].y, cuts[z + 1].z}};
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval inside;
    for (int axis = 0; axis < 3; ++axis) {
        const float o = ray.origin[axis];
        const float d = ray.direction[axis];
        if (d == 0.0F) {
            if (!(min[axis] <= o && o <= max[axis])) {
                return std::nullopt;
            }
            continue;
        }
        const float first = d > 0.0F ? min[axis] : max[axis];
        const float second = d > 0.0F ? max[axis] : min[axis];
        inside.enter = std::max(inside.enter, (first - o) / d);
        inside.leave = std::min(inside.leave, (second - o) / d);
        if (inside.leave < inside.enter) {
            return std::nullopt;
        }
    }
    return inside;
}

bool Sphere::overlaps(const Box& box) const {
    const glm::dvec3 center = center_;
    const glm::dvec3 nearest = glm::min(glm::max(center, glm::dvec3(box.min)), glm::dvec3(box.max));
    return glm::length(nearest - center) <= static_cast<double>(radius_) * (1.0 + 1e-6);
}

bool Triangle::overlaps(const Box& box) const {
    const glm::dvec3 low = box.min;
    const glm::dvec3 high = box.max;
    const glm::dvec3 center = 0.5 * (low + high);
    const glm::dvec3 half = 0.5 * (high - low);
    const std::array<glm::dvec3, 3> corner{glm::dvec3(a_) - center, glm::dvec3(b_) - center, glm::dvec3(c_) - center};
    const std::array<glm::dvec3, 3> edge{corner[1] - corner[0], corner[2] - corner[1], corner[0] - corner[2]};

    const std::array<glm::dvec3, 3> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    for (const glm::dvec3& axis : axes) {
        if (apart(corner, half, axis)) {
            return false;
        }
        for (const glm::dvec3& e : edge) {
            if (apart(corner, half, glm::cross(axis, e))) {
                return false;
            }
        }
    }
    return !apart(corner, half, glm::cross(edge[0], edge[1]));
}

Node build_octree(const SurfaceList& surfaces) {
    Node root;
    root.box = bounds_of(surfaces);
    if (surfaces.empty()) {
        return root;
    }
    const float padding = padding_within(root.box);
    root.box = root.box.padded(padding);
    divide(root, surfaces, 0, padding);
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    Search search(ray);
    if (root.box.hit(ray)) {
        search.visit(root);
    }
    return search.best();
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    const std::optional<Interval> part = root.box.hit(ray);
    if (!part || part->enter > distance) {
        return false;
    }
    for (const Surface* surface : root.surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && hit->distance < distance) {
            return true;
        }
    }
    return std::any_of(root.children.begin(), root.children.end(),
                       [&](const Node& child) { return occluded_in_octree(child, ray, distance); });
}

}  // namespace raysteps
