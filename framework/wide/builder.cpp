#include "wide/builder.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <variant>

#include "core/cone.hpp"
#include "core/sphere.hpp"
#include "core/threads.hpp"
#include "core/triangle.hpp"

namespace raysteps::wide {
namespace {

void set(std::array<Lanes, 3>& vectors, std::size_t lane, const glm::vec3& value) {
    for (int axis = 0; axis < 3; ++axis) {
        vectors[static_cast<std::size_t>(axis)][lane] = value[axis];
    }
}

void fill(TriangleBlock& block, const SurfaceList& surfaces) {
    block.sliver_bound.fill(-1.0F);
    for (std::size_t lane = 0; lane < block.surfaces.count; ++lane) {
        const auto& triangle = static_cast<const Triangle&>(*surfaces[block.surfaces.first + lane]);
        const glm::vec3 ab = triangle.b() - triangle.a();
        const glm::vec3 ac = triangle.c() - triangle.a();
        const float longest = std::max({glm::length(ab), glm::length(ac), glm::distance(triangle.b(), triangle.c())});
        const float sides = glm::length(ab) * glm::length(ac);
        const float sliver = longest * sides / glm::length(glm::cross(ab, ac));
        set(block.corner, lane, triangle.a());
        set(block.edge_ab, lane, ab);
        set(block.edge_ac, lane, ac);
        block.longest[lane] = longest;
        block.area_bound[lane] = sides;
        block.sliver_bound[lane] = std::isfinite(sliver) ? sliver : 1e30F;  // where the area is 0
    }
}

void fill(SphereBlock& block, const SurfaceList& surfaces) {
    block.radius.fill(-1.0F);
    for (std::size_t lane = 0; lane < block.surfaces.count; ++lane) {
        const auto& sphere = static_cast<const Sphere&>(*surfaces[block.surfaces.first + lane]);
        set(block.center, lane, sphere.center());
        block.radius[lane] = sphere.radius();
    }
}

void fill(ConeBlock& block, const SurfaceList& surfaces) {
    block.radius.fill(-1.0F);
    for (std::size_t lane = 0; lane < block.surfaces.count; ++lane) {
        const auto& cone = static_cast<const Cone&>(*surfaces[block.surfaces.first + lane]);
        set(block.base, lane, cone.base().center);
        const glm::dvec3 axis = glm::dvec3(cone.apex().center) - glm::dvec3(cone.base().center);
        const double length = glm::length(axis);
        const double growth = static_cast<double>(cone.apex().radius) - static_cast<double>(cone.base().radius);
        set(block.axis, lane, glm::vec3(axis / length));
        block.radius[lane] = cone.base().radius;
        block.slope[lane] = static_cast<float>(growth / length);
        block.length[lane] = static_cast<float>(length);
        block.outside[lane] = cone.sidedness() == Cone::Sidedness::both ? 1.0F : 0.0F;
    }
}

template <class Block>
void fill_all(std::vector<Block>& blocks, const SurfaceList& surfaces) {
    constexpr std::size_t k_portion = 512;
    for_each_on_threads(blocks.size(), k_portion, [&](std::size_t i) { fill(blocks[i], surfaces); });
}

std::uint32_t place(std::size_t size) {
    if (size > Reference::k_max_first) {
        throw std::length_error("this scene has too many surfaces for the wide tree: 16 million blocks are the most");
    }
    return static_cast<std::uint32_t>(size);
}

Box around(std::span<const Item> items) {
    Box all;
    for (const Item& item : items) {
        all.extend(item.box);
    }
    return all;
}

int levels_below(std::span<const Item> items) {
    int most = 0;
    for (const Item& item : items) {
        most = std::max(most, item.levels);
    }
    return most;
}

/// Which of Kind's, without nodes: from 0.
std::size_t kind_of(const Surface& surface) {
    const Kind kind =
        std::visit(ByShape{[](const Sphere*) { return Kind::spheres; }, [](const Triangle*) { return Kind::triangles; },
                           [](const SmoothTriangle*) { return Kind::triangles; },
                           [](const MeshTriangle*) { return Kind::triangles; }, [](const Cone*) { return Kind::cones; },
                           [](const Disk*) { return Kind::others; }, [](const InwardSphere*) { return Kind::others; },
                           [](std::monostate) { return Kind::others; }},
                   surface.shape());
    return static_cast<std::size_t>(kind) - 1;
}

Box bounds_of(std::span<const Surface* const> surfaces) {
    Box all;
    for (const Surface* surface : surfaces) {
        all.extend(surface->bounds());
    }
    return all;
}

Box common(const Box& a, const Box& b) { return {glm::max(a.min, b.min), glm::min(a.max, b.max)}; }

}  // namespace

float half_area(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

void Groups::add(const Surface& surface) {
    Group& group = groups_[kind_of(surface)];
    group.box.extend(surface.bounds());
    ++group.count;
}

void Groups::add(const Groups& other) {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        if (other.groups_[i].count > 0) {
            groups_[i].box.extend(other.groups_[i].box);
            groups_[i].count += other.groups_[i].count;
        }
    }
}

std::size_t Groups::size() const {
    std::size_t sum = 0;
    for (const Group& group : groups_) {
        sum += group.count;
    }
    return sum;
}

std::size_t Groups::kinds() const {
    std::size_t sum = 0;
    for (const Group& group : groups_) {
        sum += group.count > 0 ? 1 : 0;
    }
    return sum;
}

float Groups::cost() const {
    constexpr std::array k_block_costs{1.0F, 0.8F, 1.5F, 8.0F};
    float sum = 0.0F;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        const std::size_t blocks = (groups_[i].count + k_lanes - 1) / k_lanes;
        sum += blocks > 0 ? k_block_costs[i] * static_cast<float>(blocks) * half_area(groups_[i].box) : 0.0F;
    }
    return sum;
}

template <class Block>
void Builder::add_blocks(Kind kind, std::vector<Block>& blocks, const Box& box, const SurfaceList& surfaces,
                         std::vector<Item>& items) {
    constexpr std::size_t k_max_surfaces = k_lanes * Reference::k_max_blocks;  // of an item
    for (std::size_t done = 0; done < surfaces.size(); done += k_max_surfaces) {
        const std::size_t end = std::min(surfaces.size(), done + k_max_surfaces);
        const std::uint32_t first = place(blocks.size());
        for (std::size_t at = done; at < end; at += k_lanes) {
            blocks.emplace_back().surfaces = {.first = static_cast<std::uint32_t>(tree_.surfaces.size() + at - done),
                                              .count = static_cast<std::uint32_t>(std::min(k_lanes, end - at))};
        }
        const std::span<const Surface* const> part(surfaces.data() + done, end - done);
        tree_.surfaces.insert(tree_.surfaces.end(), part.begin(), part.end());
        const auto count = static_cast<std::uint32_t>(blocks.size() - first);
        items.push_back({.box = common(box, bounds_of(part)), .to = Reference(kind, first, count)});
    }
}

void Builder::add_surfaces(const Box& box, std::span<const Surface* const> surfaces, std::vector<Item>& items) {
    std::array<SurfaceList, 4> kinds;
    for (const Surface* surface : surfaces) {
        kinds[kind_of(*surface)].push_back(surface);
    }
    const auto& [triangles, spheres, cones, others] = kinds;
    add_blocks(Kind::triangles, tree_.triangles, box, triangles, items);
    add_blocks(Kind::spheres, tree_.spheres, box, spheres, items);
    add_blocks(Kind::cones, tree_.cones, box, cones, items);
    for (std::size_t done = 0; done < others.size(); done += Reference::k_max_blocks) {
        const std::size_t count = std::min<std::size_t>(Reference::k_max_blocks, others.size() - done);
        const std::span<const Surface* const> part(others.data() + done, count);
        const Reference to(Kind::others, place(tree_.surfaces.size()), static_cast<std::uint32_t>(count));
        tree_.surfaces.insert(tree_.surfaces.end(), part.begin(), part.end());
        items.push_back({.box = common(box, bounds_of(part)), .to = to});
    }
}

void Builder::write_node(Node& node, std::vector<Item> items) const {
    // Any-hit searches begin with the last: blocks, and small boxes, end them soonest.
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
        const bool a_is_node = a.to.kind() == Kind::node;
        const bool b_is_node = b.to.kind() == Kind::node;
        return a_is_node != b_is_node ? a_is_node : half_area(a.box) > half_area(b.box);
    });
    for (std::size_t lane = 0; lane < k_lanes; ++lane) {
        const bool used = lane < items.size();
        const Box box = used ? items[lane].box.padded(padding_) : Box{};
        for (int axis = 0; axis < 3; ++axis) {
            node.walls[static_cast<std::size_t>(axis)][lane] = box.min[axis];
            node.walls[static_cast<std::size_t>(axis) + 3][lane] = box.max[axis];
        }
        node.to[lane] = used ? items[lane].to : Reference(Kind::node, 0, 0);
    }
    node.count = static_cast<std::uint32_t>(items.size());
}

std::vector<Item> Builder::grouped(std::span<const Item> items) {
    std::vector<Item> groups(items.begin(), items.end());
    while (groups.size() > k_lanes) {
        std::vector<Item> fewer;
        for (std::size_t begin = 0; begin < groups.size(); begin += k_lanes) {
            const std::span<const Item> some(groups.data() + begin, std::min(k_lanes, groups.size() - begin));
            fewer.push_back(add_node(some));
        }
        groups = std::move(fewer);
    }
    return groups;
}

Item Builder::add_node(std::span<const Item> items) {
    const std::vector<Item> few = grouped(items);
    if (few.size() == 1) {
        return few.front();
    }
    const std::uint32_t at = place(tree_.nodes.size());
    write_node(tree_.nodes.emplace_back(), few);
    return {.box = around(few), .to = Reference(Kind::node, at, 0), .levels = levels_below(few) + 1};
}

Tree Builder::finish(std::span<const Item> items) {
    const std::vector<Item> few = grouped(items);
    if (levels_below(few) + 1 > k_max_levels) {
        throw std::length_error("the tree has too many levels to be searched eight boxes at a time");
    }
    write_node(tree_.nodes.front(), few);
    fill_all(tree_.triangles, tree_.surfaces);
    fill_all(tree_.spheres, tree_.surfaces);
    fill_all(tree_.cones, tree_.surfaces);
    return std::move(tree_);
}

}  // namespace raysteps::wide
