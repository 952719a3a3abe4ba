// Each surface is asked once per ray, however many boxes list it.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <unordered_set>

namespace raysteps {

using Mailbox = std::unordered_set<const Surface*>;

Box bounds_of(const SurfaceList& surfaces) {
    Box result{};
    for (auto surface : surfaces) {
        auto b = surface->bounds();
        result.min = glm::min(result.min, b.min);
        result.max = glm::max(result.max, b.max);
    }
    return result;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    const glm::vec3 m = box.min + size / 2.0F;
    std::array<Box, 8> r;
    for (int i = 0; i < 8; ++i) {
        r[i].min.x = (i & 1) ? m.x : box.min.x;
        r[i].max.x = (i & 1) ? box.max.x : m.x;
        r[i].min.y = (i & 2) ? m.y : box.min.y;
        r[i].max.y = (i & 2) ? box.max.y : m.y;
        r[i].min.z = (i & 4) ? m.z : box.min.z;
        r[i].max.z = (i & 4) ? box.max.z : m.z;
    }
    return r;
}

// Liang and Barsky: p t <= q for each of the six planes.
std::optional<Interval> Box::clip(const Ray& ray) const {
    const glm::vec3 d = ray.direction;
    const glm::vec3 o = ray.origin;
    const float p[6] = {-d.x, d.x, -d.y, d.y, -d.z, d.z};
    const float q[6] = {o.x - min.x, max.x - o.x, o.y - min.y, max.y - o.y, o.z - min.z, max.z - o.z};
    float t0 = 0.0F;
    float t1 = INFINITY;
    for (int i = 0; i < 6; ++i) {
        if (p[i] == 0) {
            if (q[i] < 0) return std::nullopt;  // parallel, and outside
        } else if (p[i] < 0) {
            t0 = std::fmax(t0, q[i] / p[i]);  // comes in
        } else {
            t1 = std::fmin(t1, q[i] / p[i]);  // goes out
        }
    }
    if (t0 > t1) return std::nullopt;
    return Interval{t0, t1};
}

static bool disjoint(const Box& u, const Box& v) {
    return u.max.x < v.min.x || v.max.x < u.min.x || u.max.y < v.min.y || v.max.y < u.min.y || u.max.z < v.min.z ||
           v.max.z < u.min.z;
}

bool Sphere::overlaps(const Box& box) const {
    const glm::vec3 nearest = glm::clamp(center(), box.min, box.max);
    const double dx = double(nearest.x) - center().x;
    const double dy = double(nearest.y) - center().y;
    const double dz = double(nearest.z) - center().z;
    return std::sqrt(dx * dx + dy * dy + dz * dz) <= radius() * 1.00001;
}

bool Triangle::overlaps(const Box& box) const {
    // a safe answer, with a little margin
    return !disjoint(bounds().padded(1e-5F), box);
}

static Node subtree(const Box& box, const SurfaceList& all, int level) {
    Node node;
    node.box = box;
    for (const Surface* surface : all)
        if (surface->overlaps(box)) node.surfaces.push_back(surface);
    if (level < 4 && node.surfaces.size() > 5) {
        for (const Box& b : split(box)) {
            Node child = subtree(b, node.surfaces, level + 1);
            if (!child.surfaces.empty() || !child.children.empty()) node.children.push_back(std::move(child));
        }
        node.surfaces.clear();
    }
    return node;
}

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) return Node{};
    return subtree(bounds_of(surfaces), surfaces, 1);
}

static void find_closest(const Node& node, const Ray& ray, Mailbox& asked, const Surface*& who,
                         std::optional<HitRecord>& best) {
    auto part = node.box.hit(ray);
    if (!part) return;
    if (best && part->enter > best->distance) return;
    for (auto surface : node.surfaces) {
        if (!asked.insert(surface).second) continue;
        auto hit = surface->hit(ray);
        if (!hit) continue;
        if (best) {
            if (hit->distance > best->distance) continue;
            if (hit->distance == best->distance && surface->order() > who->order()) continue;
        }
        best = hit;
        who = surface;
    }
    for (const auto& child : node.children) find_closest(child, ray, asked, who, best);
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    Mailbox asked;
    const Surface* who = nullptr;
    std::optional<HitRecord> best;
    find_closest(root, ray, asked, who, best);
    return best;
}

static bool find_any(const Node& node, const Ray& ray, float distance, Mailbox& asked) {
    if (!node.box.hit(ray)) return false;
    for (auto surface : node.surfaces) {
        if (!asked.insert(surface).second) continue;
        if (auto hit = surface->hit(ray); hit && hit->distance < distance) return true;
    }
    for (const auto& child : node.children)
        if (find_any(child, ray, distance, asked)) return true;
    return false;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    Mailbox asked;
    return find_any(root, ray, distance, asked);
}

}  // namespace raysteps
