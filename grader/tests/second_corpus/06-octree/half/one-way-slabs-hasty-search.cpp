#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace raysteps {

static bool boxesOverlap(const Box& a, const Box& b)
{
    if (a.max.x < b.min.x || b.max.x < a.min.x) return false;
    if (a.max.y < b.min.y || b.max.y < a.min.y) return false;
    if (a.max.z < b.min.z || b.max.z < a.min.z) return false;
    return true;
}

Box bounds_of(const SurfaceList& surfaces)
{
    Box result;
    for (const Surface* surface : surfaces)
        result.extend(surface->bounds());
    return result;
}

std::array<Box, 8> split(const Box& box)
{
    std::array<Box, 8> parts;
    const glm::vec3 mid = box.center();
    for (std::size_t i = 0; i < 8; ++i)
    {
        parts[i] = box;
        if (i & 1) parts[i].min.x = mid.x; else parts[i].max.x = mid.x;
        if (i & 2) parts[i].min.y = mid.y; else parts[i].max.y = mid.y;
        if (i & 4) parts[i].min.z = mid.z; else parts[i].max.z = mid.z;
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const
{
    float enter = 0.0f;
    float leave = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis)
    {
        const float d = ray.direction[axis];
        if (d == 0.0f)
        {
            if (ray.origin[axis] < min[axis] || ray.origin[axis] > max[axis])
                return std::nullopt;
            continue;
        }
        enter = std::max(enter, (min[axis] - ray.origin[axis]) / d);
        leave = std::min(leave, (max[axis] - ray.origin[axis]) / d);
    }
    if (enter > leave)
        return std::nullopt;
    return Interval{enter, leave};
}

bool Sphere::overlaps(const Box& box) const { return boxesOverlap(bounds(), box); }
bool Triangle::overlaps(const Box& box) const { return boxesOverlap(bounds(), box); }

static Node makeNode(const Box& box, const SurfaceList& surfaces, int level)
{
    Node node;
    node.box = box;
    if (level == 3 || surfaces.size() <= 2)
    {
        node.surfaces = surfaces;
        return node;
    }
    for (const Box& part : split(box))
    {
        SurfaceList list;
        for (const Surface* surface : surfaces)
            if (surface->overlaps(part))
                list.push_back(surface);
        if (!list.empty())
            node.children.push_back(makeNode(part, list, level + 1));
    }
    return node;
}

Node build_octree(const SurfaceList& surfaces)
{
    return makeNode(bounds_of(surfaces), surfaces, 1);
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray)
{
    if (!root.box.hit(ray))
        return std::nullopt;

    std::optional<HitRecord> best;
    for (const Surface* surface : root.surfaces)
    {
        auto hit = surface->hit(ray);
        if (hit && (!best || hit->distance < best->distance))
            best = hit;
    }
    if (best)
        return best;

    // nearest box first; the first one with a hit has the answer
    std::vector<std::pair<float, const Node*>> order;
    for (const Node& child : root.children)
        if (auto part = child.box.hit(ray))
            order.emplace_back(part->enter, &child);
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [enter, child] : order)
        if (auto hit = closest_hit_in_octree(*child, ray))
            return hit;
    return std::nullopt;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance)
{
    return closest_hit_in_octree(root, ray).has_value();
}

}  // namespace raysteps
