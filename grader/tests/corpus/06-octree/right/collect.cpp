// First collect all candidates, each once and in the scene's order; then ask them with step 02.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>

namespace raysteps {

static void collect(const Node& node, const Ray& ray, float nearer_than, SurfaceList& found) {
    const std::optional<Interval> part = node.box.hit(ray);
    if (!part.has_value() || part->enter > nearer_than) return;
    found.insert(found.end(), node.surfaces.begin(), node.surfaces.end());
    for (const Node& child : node.children) collect(child, ray, nearer_than, found);
}

static SurfaceList candidates(const Node& root, const Ray& ray, float nearer_than) {
    SurfaceList found;
    collect(root, ray, nearer_than, found);
    // by order; the pointer too, should two have the same order
    std::sort(found.begin(), found.end(), [](const Surface* a, const Surface* b) {
        return a->order() != b->order() ? a->order() < b->order() : std::less<const Surface*>()(a, b);
    });
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

Box bounds_of(const SurfaceList& surfaces) {
    if (surfaces.empty()) return Box{};
    Box box = surfaces.front()->bounds();
    for (auto it = std::next(surfaces.begin()); it != surfaces.end(); ++it) box.extend((*it)->bounds());
    return box;
}

std::array<Box, 8> split(const Box& box) {
    std::array<Box, 8> parts;
    parts.fill(box);
    const glm::vec3 m = (box.min + box.max) / 2.0F;
    for (int i = 0; i < 8; i++) {
        (i & 1 ? parts[i].min : parts[i].max).x = m.x;
        (i & 2 ? parts[i].min : parts[i].max).y = m.y;
        (i & 4 ? parts[i].min : parts[i].max).z = m.z;
    }
    return parts;
}

// Cuts [interval] down to where low <= o + t d <= high. False: nothing is left.
static bool cut(Interval& interval, float o, float d, float low, float high) {
    if (low > high) return false;
    if (d == 0.0F) return low <= o && o <= high;
    const float t_low = (low - o) / d;
    const float t_high = (high - o) / d;
    interval.enter = std::max(interval.enter, std::min(t_low, t_high));
    interval.leave = std::min(interval.leave, std::max(t_low, t_high));
    return interval.enter <= interval.leave;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval interval;
    const glm::vec3& o = ray.origin;
    const glm::vec3& d = ray.direction;
    const bool left = cut(interval, o.x, d.x, min.x, max.x) && cut(interval, o.y, d.y, min.y, max.y) &&
                      cut(interval, o.z, d.z, min.z, max.z);
    return left ? std::make_optional(interval) : std::nullopt;
}

static bool meet(const Box& p, const Box& q) {
    return p.min.x <= q.max.x && p.max.x >= q.min.x &&  //
           p.min.y <= q.max.y && p.max.y >= q.min.y &&  //
           p.min.z <= q.max.z && p.max.z >= q.min.z;
}

bool Sphere::overlaps(const Box& box) const { return meet(bounds(), box); }
bool Triangle::overlaps(const Box& box) const { return meet(bounds(), box); }

static Node build(const Box& box, SurfaceList list, int depth) {
    if (depth == 0) return Node{box, std::move(list), {}};
    Node node;
    node.box = box;
    for (const Box& part : split(box)) {
        SurfaceList share;
        std::copy_if(list.begin(), list.end(), std::back_inserter(share), [&part](auto* s) { return s->overlaps(part); });
        if (!share.empty()) node.children.push_back(build(part, std::move(share), depth - 1));
    }
    return node;
}

Node build_octree(const SurfaceList& surfaces) {
    const Box world = bounds_of(surfaces);
    return surfaces.size() < 8 ? Node{world, surfaces, {}} : build(world, surfaces, 3);
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    return closest_hit(candidates(root, ray, std::numeric_limits<float>::infinity()), ray);
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    for (const Surface* s : candidates(root, ray, distance)) {
        if (const auto hit = s->hit(ray); hit && hit->distance < distance) return true;
    }
    return false;
}

}  // namespace raysteps
