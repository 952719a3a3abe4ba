#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace raysteps {

namespace {

constexpr std::uint32_t k_leaf = 3;

void build(Bvh& bvh, std::uint32_t place, std::uint32_t first, std::uint32_t count)
{
    Box box, middles;
    for (std::uint32_t i = first; i < first + count; ++i)
    {
        const Box one = bvh.surfaces[i]->bounds();
        box.extend(one);
        middles.extend(one.center());
    }
    bvh.nodes[place].box = box;
    if (count <= k_leaf)
    {
        bvh.nodes[place].first = first;
        bvh.nodes[place].count = count;
        return;
    }
    const glm::vec3 size = middles.max - middles.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    const auto begin = bvh.surfaces.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [axis](const Surface* a, const Surface* b) {
        return a->bounds().center()[axis] < b->bounds().center()[axis];
    });
    const auto child = static_cast<std::uint32_t>(bvh.nodes.size());
    bvh.nodes.resize(bvh.nodes.size() + 2);
    bvh.nodes[place].first = child;
    build(bvh, child, first, half);
    build(bvh, child + 1, first + half, count - half);
}

std::optional<HitRecord> visit(const Bvh& bvh, const BvhNode& node, const Ray& ray)
{
    if (node.is_leaf())
    {
        std::optional<HitRecord> best;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        {
            auto hit = bvh.surfaces[i]->hit(ray);
            if (hit && (!best || hit->distance < best->distance))
                best = hit;
        }
        return best;
    }
    const BvhNode* near = &bvh.nodes[node.first];
    const BvhNode* far = &bvh.nodes[node.first + 1];
    auto near_part = near->box.hit(ray);
    auto far_part = far->box.hit(ray);
    if (far_part && (!near_part || far_part->enter < near_part->enter))
    {
        std::swap(near, far);
        std::swap(near_part, far_part);
    }
    if (near_part)
        if (auto hit = visit(bvh, *near, ray))
            return hit;  // nothing in the farther box can be nearer
    if (far_part)
        return visit(bvh, *far, ray);
    return std::nullopt;
}

}  // namespace

float surface_area(const Box& box)
{
    const float x = box.max.x - box.min.x;
    const float y = box.max.y - box.min.y;
    const float z = box.max.z - box.min.z;
    if (x < 0.0F || y < 0.0F || z < 0.0F)
        return 0.0F;
    return 2.0F * x * y + 2.0F * y * z + 2.0F * z * x;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole)
{
    const float n_left = static_cast<float>(left_count);
    const float n_right = static_cast<float>(right_count);
    const float area = surface_area(whole);
    if (area == 0.0F)
        return k_two_box_tests + n_left + n_right;
    return k_two_box_tests + (surface_area(left) * n_left + surface_area(right) * n_right) / area;
}

Bvh build_bvh(const SurfaceList& surfaces)
{
    Bvh bvh;
    if (surfaces.empty())
        return bvh;
    bvh.surfaces = surfaces;
    bvh.nodes.resize(1);
    build(bvh, 0, 0, static_cast<std::uint32_t>(surfaces.size()));
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray)
{
    if (bvh.nodes.empty() || !bvh.nodes[0].box.hit(ray))
        return std::nullopt;
    return visit(bvh, bvh.nodes[0], ray);
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance)
{
    return closest_hit_in_bvh(bvh, ray).has_value();
}

}  // namespace raysteps
