#include "steps/06-octree/octree.hpp"

#include "core/unfinished.hpp"

#include "core/box_tests.hpp"
#include "core/rounding.hpp"
#include "core/threads.hpp"

#include <cstdint>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <limits>
#include <utility>

namespace raysteps {

namespace {

constexpr int k_max_depth = 12;
constexpr std::size_t k_leaf_size = 8;
constexpr std::size_t k_max_growth = 4;          // children may hold this many times the parent's surfaces
constexpr std::uint64_t k_max_references = 24;   // of a surface on average, whatever the scene
constexpr std::size_t k_enough_surfaces = 4096;  // to be worth several threads

float diagonal(const Box& box) { return glm::length(box.max - box.min); }

/// Whether a line of direction `axis` separates the triangle from a box centred at the origin.
bool separates(const glm::vec3& axis, const std::array<glm::vec3, 3>& corners, const glm::vec3& half) {
    const float a = glm::dot(axis, corners[0]);
    const float b = glm::dot(axis, corners[1]);
    const float c = glm::dot(axis, corners[2]);
    const float reach = glm::dot(glm::abs(axis), half);
    return (a > reach && b > reach && c > reach) || (a < -reach && b < -reach && c < -reach);
}

bool boxes_overlap(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

/// A part of the tree that is still to be built.
struct Part {
    Node* node = nullptr;
    Box cell;
    SurfaceList surfaces;
    std::uint64_t most_references = 0;  // in the lists of all boxes below
    int depth = 0;
};

/// Hands the surfaces on to the eight parts of the cell, or makes a leaf. Those that got any come first, and each has a
/// child of the node.
std::array<Part, 8> split_part(Part& part, float padding) {
    const SurfaceList& surfaces = part.surfaces;
    const Box all = bounds_of(surfaces);  // rays miss a smaller box more often
    part.node->box = Box{glm::max(part.cell.min, all.min), glm::min(part.cell.max, all.max)}.padded(padding);
    if (surfaces.size() > k_leaf_size && part.depth < k_max_depth) {
        std::array<Part, 8> parts;
        std::size_t used = 0;
        std::size_t references = 0;
        for (const Box& cell : split(part.cell)) {
            Part& inside = parts[used];
            inside.cell = cell;
            inside.depth = part.depth + 1;
            for (const Surface* surface : surfaces) {
                if (surface->overlaps(cell)) {
                    inside.surfaces.push_back(surface);
                }
            }
            references += inside.surfaces.size();
            used += inside.surfaces.empty() ? 0U : 1U;
        }
        // Where the boxes are already smaller than the surfaces, splitting multiplies lists and sorts nothing out.
        if (references <= std::min<std::uint64_t>(k_max_growth * surfaces.size(), part.most_references)) {
            part.node->children = std::vector<Node>(used);
            for (std::size_t i = 0; i < used; ++i) {
                parts[i].node = &part.node->children[i];
                parts[i].most_references = part.most_references * parts[i].surfaces.size() / references;
            }
            return parts;
        }
    }
    part.node->surfaces = SurfaceList(surfaces);  // a copy, as that takes no more room than it needs
    return {};
}

/// The parts of a large one on all threads.
void build_below(Part& part, float padding) {
    const bool large = part.surfaces.size() >= k_enough_surfaces;
    std::array<Part, 8> parts = split_part(part, padding);
    part.surfaces = SurfaceList();
    const std::size_t used = part.node->children.size();
    const auto build_one = [&](std::size_t i) { build_below(parts[i], padding); };
    if (large) {
        for_each_on_threads(used, 1, build_one);
    } else {
        for (std::size_t i = 0; i < used; ++i) {
            build_one(i);
        }
    }
}

/// Surfaces larger than this would stretch the boxes over everything else: a ground under a flake of spheres.
float largest_below(const SurfaceList& surfaces) {
    constexpr float k_share_of_scene = 0.25F;
    constexpr float k_times_median = 20.0F;
    const std::size_t step = 1 + surfaces.size() / 1024;  // a thousand of them tell the median well enough
    std::vector<float> sizes((surfaces.size() + step - 1) / step);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        sizes[i] = diagonal(surfaces[i * step]->bounds());
    }
    std::sort(sizes.begin(), sizes.end());
    const float median = sizes[sizes.size() / 2];
    return std::max(k_share_of_scene * diagonal(bounds_of(surfaces)), k_times_median * median);
}

/// Shortens the part of the ray to what is inside the box. Along an axis whose direction is 0 the distances are
/// infinite: they leave the part as it is, or make it empty where the origin is outside. On the very plane 0 * infinity
/// is NaN, which max and min pass over where it is the second of their two numbers.
inline std::optional<Interval> part_inside(const Box& box, const glm::vec3& origin, const glm::vec3& inverse,
                                           Interval part) {
    for (int axis = 0; axis < 3; ++axis) {
        const bool upwards = inverse[axis] >= 0.0F;
        const float near_plane = upwards ? box.min[axis] : box.max[axis];
        const float far_plane = upwards ? box.max[axis] : box.min[axis];
        part.enter = std::max(part.enter, (near_plane - origin[axis]) * inverse[axis]);
        part.leave = std::min(part.leave, (far_plane - origin[axis]) * inverse[axis]);
    }
    return part.enter <= part.leave ? std::optional(part) : std::nullopt;
}

/// A ray on its way through the tree, and the nearest hit so far. It divides once, and not at every box.
struct Search {
    const Ray& ray;
    glm::vec3 inverse = 1.0F / ray.direction;
    BoxTests tests{ray};
    std::optional<HitRecord> hit = std::nullopt;
    float distance = std::numeric_limits<float>::infinity();  // of the hit
    std::size_t order = 0;                                    // of its surface

    /// The part of the ray inside the box; nothing where it begins behind the limit.
    std::optional<Interval> enter(const Box& box, float limit) {
        tests.add(box);
        return part_inside(box, ray.origin, inverse, {0.0F, limit * (1.0F + k_distance_slack)});
    }

    /// Boxes are not visited in the order of the scene, so surfaces at the same distance are told apart by it.
    void test(const SurfaceList& surfaces) {
        for (const Surface* surface : surfaces) {
            const std::optional<HitRecord> found = surface->hit(ray);
            if (found && (found->distance < distance || (found->distance == distance && surface->order() < order))) {
                hit = found;
                distance = found->distance;
                order = surface->order();
            }
        }
    }
};

void visit(const Node& node, Search& search) {
    search.test(node.surfaces);

    struct Entry {
        float enter;
        const Node* child;
    };
    std::array<Entry, 8> entries;  // sorted by where the ray enters
    std::size_t count = 0;
    for (const Node& child : node.children) {
        if (const std::optional<Interval> part = search.enter(child.box, search.distance)) {
            std::size_t place = count++;
            for (; place > 0 && part->enter < entries[place - 1].enter; --place) {
                entries[place] = entries[place - 1];
            }
            entries[place] = {part->enter, &child};
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (entries[i].enter * (1.0F - k_distance_slack) > search.distance) {
            return;  // all that is in this box is behind the hit, and in all boxes after it
        }
        visit(*entries[i].child, search);
    }
}

bool has_hit_before(float distance, const Node& root, Search& search) {
    const auto is_near = [&](const Surface* surface) {
        const std::optional<HitRecord> hit = surface->hit(search.ray);
        return hit && hit->distance < distance;
    };
    const auto has_near = [&](const Node& child) {
        return search.enter(child.box, distance) && has_hit_before(distance, child, search);
    };
    return std::any_of(root.surfaces.begin(), root.surfaces.end(), is_near) ||
           std::any_of(root.children.begin(), root.children.end(), has_near);
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
    const glm::vec3 middle = box.center();
    std::array<Box, 8> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const glm::bvec3 upper((i & 1U) != 0U, (i & 2U) != 0U, (i & 4U) != 0U);
        parts[i] = {glm::mix(box.min, middle, upper), glm::mix(middle, box.max, upper)};
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    return part_inside(*this, ray.origin, 1.0F / ray.direction, {});
}

bool Sphere::overlaps(const Box& box) const {
    const glm::vec3 nearest = glm::clamp(center_, box.min, box.max);
    const glm::vec3 farthest = glm::max(glm::abs(box.min - center_), glm::abs(box.max - center_));
    const float slack = 1.0F + 1e-5F;  // for rounding: a "no" too many loses hits
    const bool reaches = glm::distance(center_, nearest) <= radius_ * slack;
    const bool holds_all_of_box = glm::length(farthest) * slack < radius_;  // a sphere is a shell, not a ball
    return reaches && !holds_all_of_box;
}

bool Triangle::overlaps(const Box& box) const {
    if (!boxes_overlap(bounds(), box)) {
        return false;
    }
    // Separating axes (Akenine-Moller 2001): the triangle's normal, and each edge with each axis of the box.
    const glm::vec3 center = box.center();
    const glm::vec3 half = 0.5F * (box.max - box.min);
    const glm::vec3 padded = half + 1e-6F * (glm::abs(center) + half);  // for rounding, too
    const std::array<glm::vec3, 3> corners{a_ - center, b_ - center, c_ - center};
    const std::array<glm::vec3, 3> edges{b_ - a_, c_ - b_, a_ - c_};
    if (separates(glm::cross(edges[0], edges[1]), corners, padded)) {
        return false;
    }
    for (const glm::vec3& edge : edges) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 unit(0.0F);
            unit[axis] = 1.0F;
            if (separates(glm::cross(unit, edge), corners, padded)) {
                return false;
            }
        }
    }
    return true;
}

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) {
        return {};
    }
    constexpr std::size_t k_max_above = 8;
    const float limit = largest_below(surfaces);
    SurfaceList large;
    SurfaceList others;
    for (const Surface* surface : surfaces) {
        if (diagonal(surface->bounds()) > limit) {
            large.push_back(surface);
        } else {
            others.push_back(surface);
        }
    }
    if (large.size() > k_max_above) {
        large.clear();
        others = SurfaceList(surfaces);
    }
    const Box all = bounds_of(surfaces);
    const float padding = padding_within(all);
    Node root{.box = all.padded(padding), .surfaces = std::move(large), .children = {}};
    if (!others.empty()) {
        // Off centre: people model on grids, and what ends in the very middle would be in the cells on both sides.
        const Box tight = bounds_of(others);
        const Box box{tight.min - 4.0F * padding, tight.max + 8.0F * padding};
        const std::uint64_t most_references = k_max_references * others.size();
        Node* const below = &root.children.emplace_back();
        Part part{
            .node = below, .cell = box, .surfaces = std::move(others), .most_references = most_references, .depth = 0};
        build_below(part, padding);
    }
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    Search search{ray};
    if (search.enter(root.box, search.distance)) {
        visit(root, search);
    }
    return search.hit;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    Search search{ray};
    return search.enter(root.box, distance) && has_hit_before(distance, root, search);
}

}  // namespace raysteps
