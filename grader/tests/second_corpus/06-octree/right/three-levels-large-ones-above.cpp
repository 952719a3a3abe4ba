// The paper's 1 + 8 + 64 boxes, empty ones kept. What touches all eight parts of a middle box stays in that box.
// Boxes are searched with a stack, in the order in which they stand.
#include "steps/06-octree/octree.hpp"

#include "core/rounding.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace raysteps {

namespace {

bool common_point(const Box& a, const Box& b) {
    for (int i = 0; i < 3; i++) {
        const float low = a.min[i] > b.min[i] ? a.min[i] : b.min[i];
        const float high = a.max[i] < b.max[i] ? a.max[i] : b.max[i];
        if (low > high) return false;
    }
    return true;
}

Node leaf(const Box& box, const SurfaceList& from) {
    Node node;
    node.box = box;
    for (const Surface* s : from) {
        if (s->overlaps(box)) node.surfaces.push_back(s);
    }
    return node;
}

void cut(Node& node, bool keep_large) {
    const auto parts = split(node.box);
    SurfaceList passed_on, kept;
    for (const Surface* s : node.surfaces) {
        int touched = 0;
        for (const Box& part : parts) touched += s->overlaps(part) ? 1 : 0;
        // none at all can only be rounding: keep it, too
        (touched == 0 || (keep_large && touched == 8) ? kept : passed_on).push_back(s);
    }
    for (const Box& part : parts) node.children.push_back(leaf(part, passed_on));
    node.surfaces = std::move(kept);
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box sum;
    for (std::size_t i = 0; i != surfaces.size(); ++i) {
        const Box one = surfaces[i]->bounds();
        sum.min = glm::min(sum.min, one.min);
        sum.max = glm::max(sum.max, one.max);
    }
    return sum;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 c = box.center();
    std::array<Box, 8> out;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::bvec3 upper((i & 1U) != 0, (i & 2U) != 0, (i & 4U) != 0);
        out[i] = Box{glm::mix(box.min, c, upper), glm::mix(c, box.max, upper)};
    }
    return out;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const double o = ray.origin[i];
        const double d = ray.direction[i];
        const double to_min = min[i] - o;
        const double to_max = max[i] - o;
        if (d == 0.0) {
            if (to_min > 0.0 || to_max < 0.0) return std::nullopt;
        } else {
            double t1 = to_min / d;
            double t2 = to_max / d;
            if (t1 > t2) std::swap(t1, t2);
            if (t1 > enter) enter = t1;
            if (t2 < leave) leave = t2;
        }
    }
    if (enter > leave) return std::nullopt;
    return Interval{static_cast<float>(enter), static_cast<float>(leave)};
}

bool Sphere::overlaps(const Box& box) const { return common_point(bounds(), box); }

bool Triangle::overlaps(const Box& box) const { return common_point(bounds(), box); }

Node build_octree(const SurfaceList& surfaces) {
    Node root;
    root.box = bounds_of(surfaces);
    root.surfaces = surfaces;
    if (surfaces.size() < 2) return root;
    root.box = root.box.padded(padding_within(root.box));
    cut(root, false);
    for (Node& child : root.children) {
        if (child.surfaces.size() > 1) cut(child, true);
    }
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<HitRecord> best;
    std::size_t best_order = 0;
    std::vector<const Node*> waiting{&root};
    while (!waiting.empty()) {
        const Node& node = *waiting.back();
        waiting.pop_back();
        if (node.surfaces.empty() && node.children.empty()) continue;
        const auto part = node.box.hit(ray);
        if (!part) continue;
        if (best && part->enter > best->distance * (1.0F + k_distance_slack)) continue;
        for (const Surface* s : node.surfaces) {
            const auto hit = s->hit(ray);
            if (!hit) continue;
            if (best && hit->distance > best->distance) continue;
            if (best && hit->distance == best->distance && s->order() > best_order) continue;
            best = hit;
            best_order = s->order();
        }
        for (const Node& child : node.children) waiting.push_back(&child);
    }
    return best;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    // Any answer of closest_hit is one of this function, too; it only costs more.
    const auto hit = closest_hit_in_octree(root, ray);
    return hit.has_value() && hit->distance < distance;
}

}  // namespace raysteps
