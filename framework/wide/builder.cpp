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
    for (std::size_t lane = 0; lane < block.count; ++lane) {
        const auto& triangle = static_cast<const Triangle&>(*surfaces[block.surface[lane]]);
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
    for (std::size_t lane = 0; lane < block.count; ++lane) {
        const auto& sphere = static_cast<const Sphere&>(*surfaces[block.surface[lane]]);
        set(block.center, lane, sphere.center());
        block.radius[lane] = sphere.radius();
    }
}

void fill(ConeBlock& block, const SurfaceList& surfaces) {
    block.radius.fill(-1.0F);
    for (std::size_t lane = 0; lane < block.count; ++lane) {
        const auto& cone = static_cast<const Cone&>(*surfaces[block.surface[lane]]);
        set(block.base, lane, cone.base().center);
        const glm::dvec3 axis = glm::dvec3(cone.apex().center) - glm::dvec3(cone.base().center);
        set(block.axis, lane, glm::vec3(glm::normalize(axis)));
        block.radius[lane] = std::max(cone.base().radius, cone.apex().radius);
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

}  // namespace

template <class Block>
void Builder::add_blocks(Kind kind, std::vector<Block>& blocks, const Box& box, const SurfaceList& surfaces,
                         std::vector<Item>& items) {
    std::size_t done = 0;
    while (done < surfaces.size()) {
        const std::uint32_t first = place(blocks.size());
        std::uint32_t count = 0;
        for (; count < Reference::k_max_blocks && done < surfaces.size(); ++count) {
            Block& block = blocks.emplace_back();
            for (; block.count < k_lanes && done < surfaces.size(); ++block.count, ++done) {
                block.surface[block.count] = static_cast<std::uint32_t>(tree_.surfaces.size());
                tree_.surfaces.push_back(surfaces[done]);
            }
        }
        items.push_back({.box = box, .to = Reference(kind, first, count)});
    }
}

void Builder::add_surfaces(const Box& box, std::span<const Surface* const> surfaces, std::vector<Item>& items) {
    SurfaceList triangles;
    SurfaceList spheres;
    SurfaceList cones;
    SurfaceList others;
    for (const Surface* surface : surfaces) {
        std::visit(ByShape{[&](const Sphere*) { spheres.push_back(surface); },
                           [&](const Triangle*) { triangles.push_back(surface); },
                           [&](const SmoothTriangle*) { triangles.push_back(surface); },
                           [&](const Cone*) { cones.push_back(surface); },
                           [&](const InwardSphere*) { others.push_back(surface); },
                           [&](std::monostate) { others.push_back(surface); }},
                   surface->shape());
    }
    add_blocks(Kind::triangles, tree_.triangles, box, triangles, items);
    add_blocks(Kind::spheres, tree_.spheres, box, spheres, items);
    add_blocks(Kind::cones, tree_.cones, box, cones, items);
    for (std::size_t done = 0; done < others.size();) {
        const std::size_t count = std::min<std::size_t>(Reference::k_max_blocks, others.size() - done);
        const Reference to(Kind::others, place(tree_.others.size()), static_cast<std::uint32_t>(count));
        items.push_back({.box = box, .to = to});
        for (const std::size_t end = done + count; done < end; ++done) {
            tree_.others.push_back(static_cast<std::uint32_t>(tree_.surfaces.size()));
            tree_.surfaces.push_back(others[done]);
        }
    }
}

void Builder::write_node(Node& node, std::span<const Item> items) const {
    for (std::size_t lane = 0; lane < k_lanes; ++lane) {
        const bool used = lane < items.size();
        const Box box = used ? items[lane].box.padded(padding_) : Box{};
        set(node.low, lane, box.min);
        set(node.high, lane, box.max);
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
