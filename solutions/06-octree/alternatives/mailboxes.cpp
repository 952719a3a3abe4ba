// A deep tree with leaves of three surfaces, visited in the order of the children without any sorting; a list of the
// surfaces that the ray has met already (mailboxes) keeps it from testing one twice. Slabs have separate branches for
// rays to the left, to the right and along them, and a triangle is told apart from a box by bounds and plane.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_set>

namespace raysteps {
namespace {

constexpr std::size_t k_leaf_size = 3;
constexpr int k_deepest = 6;

struct Search {
    const Ray& ray;
    std::unordered_set<const Surface*> tested;
    const Surface* surface = nullptr;
    std::optional<HitRecord> hit;

    void ask(const Surface* candidate) {
        if (!tested.insert(candidate).second) {
            return;
        }
        const std::optional<HitRecord> found = candidate->hit(ray);
        if (!found) {
            return;
        }
        const bool nearer = !hit || found->distance < hit->distance;
        const bool earlier = hit && found->distance == hit->distance && candidate->order() < surface->order();
        if (nearer || earlier) {
            hit = found;
            surface = candidate;
        }
    }
};

void look_into(const Node& node, Search& search) {
    if (!node.box.hit(search.ray)) {
        return;
    }
    for (const Surface* surface : node.surfaces) {
        search.ask(surface);
    }
    for (const Node& child : node.children) {
        look_into(child, search);
    }
}

/// Whether the ray meets something nearer than the distance. The closest hit so far is never farther than the last one.
bool meets_before(const Node& node, float distance, Search& search) {
    if (!node.box.hit(search.ray)) {
        return false;
    }
    for (const Surface* surface : node.surfaces) {
        search.ask(surface);
        if (search.hit && search.hit->distance < distance) {
            return true;
        }
    }
    return std::any_of(node.children.begin(), node.children.end(),
                       [&](const Node& child) { return meets_before(child, distance, search); });
}

bool apart(const Box& a, const Box& b, float slack) {
    return a.min.x > b.max.x + slack || a.min.y > b.max.y + slack || a.min.z > b.max.z + slack ||
           b.min.x > a.max.x + slack || b.min.y > a.max.y + slack || b.min.z > a.max.z + slack;
}

float largest_coordinate(const Box& box) {
    const glm::vec3 size = glm::max(glm::abs(box.min), glm::abs(box.max));
    return std::max({size.x, size.y, size.z});
}

/// `cell` divides the space; the node's own box is a little larger than it.
Node divide(const Box& cell, const SurfaceList& surfaces, int depth, float slack) {
    Node node;
    node.box = cell.padded(slack);
    if (surfaces.size() <= k_leaf_size || depth == k_deepest) {
        node.surfaces = surfaces;
        return node;
    }
    std::vector<Node> children;
    std::size_t shared = 0;
    for (const Box& part : split(cell)) {
        const Box reach = part.padded(slack);
        SurfaceList inside;
        for (const Surface* surface : surfaces) {
            if (surface->overlaps(reach)) {
                inside.push_back(surface);
            }
        }
        shared += inside.size() == surfaces.size() ? 1 : 0;
        if (!inside.empty()) {
            // A part that has them all is not worth another level.
            const int next = inside.size() == surfaces.size() ? std::max(depth + 1, k_deepest - 1) : depth + 1;
            children.push_back(divide(part, inside, next, slack));
        }
    }
    if (shared > 4) {
        node.surfaces = surfaces;
    } else {
        node.children = std::move(children);
    }
    return node;
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    if (surfaces.empty()) {
        return Box{};
    }
    Box all = surfaces.front()->bounds();
    std::for_each(surfaces.begin() + 1, surfaces.end(), [&all](const Surface* surface) {
        const Box own = surface->bounds();
        all = {glm::min(own.min, all.min), glm::max(own.max, all.max)};
    });
    return all;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 middle = (box.min + box.max) / 2.0F;
    std::array<Box, 8> parts;
    parts.fill(box);
    for (std::size_t i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = ((i >> axis) & 1U) == 1U;
            (upper ? parts[i].min : parts[i].max)[axis] = middle[axis];
        }
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float origin = ray.origin[axis];
        const float direction = ray.direction[axis];
        float slab_enter = 0.0F;
        float slab_leave = leave;
        if (direction > 0.0F) {
            slab_enter = (min[axis] - origin) / direction;
            slab_leave = (max[axis] - origin) / direction;
        } else if (direction < 0.0F) {
            slab_enter = (max[axis] - origin) / direction;
            slab_leave = (min[axis] - origin) / direction;
        } else if (origin < min[axis] || origin > max[axis]) {
            return std::nullopt;
        }
        enter = slab_enter > enter ? slab_enter : enter;
        leave = slab_leave < leave ? slab_leave : leave;
    }
    if (leave < enter) {
        return std::nullopt;
    }
    return Interval{.enter = enter, .leave = leave};
}

bool Sphere::overlaps(const Box& box) const {
    const glm::vec3 outside = glm::max(glm::max(box.min - center_, center_ - box.max), glm::vec3(0.0F));
    return glm::length(outside) <= radius_ + 1e-5F * (radius_ + glm::length(center_));
}

bool Triangle::overlaps(const Box& box) const {
    const float slack = 1e-5F * largest_coordinate(box);
    if (apart(bounds(), box, slack)) {
        return false;
    }
    // Do all corners of the box lie on one side of the plane? Only the two farthest along the normal matter.
    const glm::vec3 normal = glm::normalize(glm::cross(b_ - a_, c_ - a_));
    if (glm::any(glm::isnan(normal))) {
        return true;  // the triangle has no area
    }
    const glm::vec3 low = glm::mix(box.max, box.min, glm::greaterThan(normal, glm::vec3(0.0F)));
    const glm::vec3 high = glm::mix(box.min, box.max, glm::greaterThan(normal, glm::vec3(0.0F)));
    return glm::dot(normal, low - a_) <= slack && glm::dot(normal, high - a_) >= -slack;
}

Node build_octree(const SurfaceList& surfaces) {
    const Box all = bounds_of(surfaces);
    return surfaces.empty() ? Node{} : divide(all, surfaces, 0, 1e-5F * largest_coordinate(all));
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    Search search{ray, {}, nullptr, std::nullopt};
    look_into(root, search);
    return search.hit;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    Search search{ray, {}, nullptr, std::nullopt};
    return meets_before(root, distance, search);
}

}  // namespace raysteps
