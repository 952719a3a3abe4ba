// The paper's way: three levels of eight boxes, bounds for overlap, every leaf that the ray meets is searched.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace raysteps {

Box bounds_of(const SurfaceList& surfaces) {
    Box all;
    for (auto* s : surfaces) {
        const Box b = s->bounds();
        for (int i = 0; i < 3; i++) {
            if (b.min[i] < all.min[i]) all.min[i] = b.min[i];
            if (b.max[i] > all.max[i]) all.max[i] = b.max[i];
        }
    }
    return all;
}

std::array<Box, 8> split(const Box& box) {
    std::array<Box, 8> out;
    const glm::vec3 mid = (box.min + box.max) / 2.0f;
    for (int i = 0; i < 8; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const bool high = (i >> axis) & 1;
            out[i].min[axis] = high ? mid[axis] : box.min[axis];
            out[i].max[axis] = high ? box.max[axis] : mid[axis];
        }
    }
    return out;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    float t0 = 0;
    float t1 = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 3; i++) {
        const float o = ray.origin[i];
        const float d = ray.direction[i];
        if (d == 0) {
            if (o < min[i] || o > max[i]) return {};
            continue;
        }
        float a = (min[i] - o) / d;
        float b = (max[i] - o) / d;
        if (a > b) std::swap(a, b);
        if (a > t0) t0 = a;
        if (b < t1) t1 = b;
        if (t0 > t1) return {};
    }
    return Interval{t0, t1};
}

bool Sphere::overlaps(const Box& box) const {
    float squared = 0;
    for (int i = 0; i < 3; i++) {
        const float below = box.min[i] - center_[i];
        const float above = center_[i] - box.max[i];
        const float off = std::max({below, above, 0.0f});
        squared += off * off;
    }
    return squared <= radius_ * radius_ * 1.0001f;
}

bool Triangle::overlaps(const Box& box) const {
    const glm::vec3 low = glm::min(a_, glm::min(b_, c_));
    const glm::vec3 high = glm::max(a_, glm::max(b_, c_));
    for (int i = 0; i < 3; i++) {
        if (low[i] > box.max[i] || high[i] < box.min[i]) return false;
    }
    return true;
}

static Node make(const Box& box, const SurfaceList& from, int level) {
    Node node;
    node.box = box;
    SurfaceList mine;
    for (auto* s : from) {
        if (s->overlaps(box)) mine.push_back(s);
    }
    if (level == 3 || mine.size() <= 4) {
        node.surfaces = mine;
        return node;
    }
    for (const Box& part : split(box)) {
        Node child = make(part, mine, level + 1);
        node.children.push_back(child);
    }
    return node;
}

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) return Node{};
    Box all = bounds_of(surfaces);
    const float more = 1e-4f * glm::length(all.max - all.min) + 1e-5f;
    all.min -= more;
    all.max += more;
    return make(all, surfaces, 0);
}

static void search(const Node& node, const Ray& ray, std::optional<HitRecord>& best, std::size_t& order) {
    if (!node.box.hit(ray)) return;
    for (auto* s : node.surfaces) {
        auto hit = s->hit(ray);
        if (!hit) continue;
        if (!best || hit->distance < best->distance || (hit->distance == best->distance && s->order() < order)) {
            best = hit;
            order = s->order();
        }
    }
    for (const Node& child : node.children) search(child, ray, best, order);
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<HitRecord> best;
    std::size_t order = 0;
    search(root, ray, best, order);
    return best;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    if (!root.box.hit(ray)) return false;
    for (auto* s : root.surfaces) {
        auto hit = s->hit(ray);
        if (hit && hit->distance < distance) return true;
    }
    for (const Node& child : root.children) {
        if (occluded_in_octree(child, ray, distance)) return true;
    }
    return false;
}

}  // namespace raysteps
