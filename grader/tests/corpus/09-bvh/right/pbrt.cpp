// After PBRT: build with pointers first, then flatten.
#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace raysteps {

struct BVHPrimitiveInfo {
    const Surface* primitive;
    Box bounds;
    glm::vec3 centroid;
};

struct BVHBuildNode {
    Box bounds;
    std::unique_ptr<BVHBuildNode> children[2];
    SurfaceList primitives;
};

static int MaximumExtent(const Box& b) {
    const glm::vec3 d = b.max - b.min;
    if (d.x > d.y && d.x > d.z) return 0;
    return d.y > d.z ? 1 : 2;
}

float surface_area(const Box& b) {
    if (b.min.x > b.max.x || b.min.y > b.max.y || b.min.z > b.max.z) return 0;
    const double x = double(b.max.x) - b.min.x;
    const double y = double(b.max.y) - b.min.y;
    const double z = double(b.max.z) - b.min.z;
    return float(2 * (x * y + x * z + y * z));
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float total = surface_area(whole);
    const float p0 = total == 0 ? 1 : surface_area(left) / total;
    const float p1 = total == 0 ? 1 : surface_area(right) / total;
    float cost = k_two_box_tests;
    cost += p0 * float(left_count);
    cost += p1 * float(right_count);
    return cost;
}

// start, end: half open. Split at the middle of the centroids, or into equal counts where that fails.
static std::unique_ptr<BVHBuildNode> recursiveBuild(std::vector<BVHPrimitiveInfo>& info, int start, int end, int level) {
    auto node = std::make_unique<BVHBuildNode>();
    Box centroids;
    for (int i = start; i < end; ++i) {
        node->bounds.extend(info[i].bounds);
        centroids.extend(info[i].centroid);
    }
    if (end - start <= 3) {
        for (int i = start; i < end; ++i) node->primitives.push_back(info[i].primitive);
        return node;
    }
    const int dim = MaximumExtent(centroids);
    const float pmid = (centroids.min[dim] + centroids.max[dim]) / 2;
    int mid = start;
    if (level < 32) {
        const auto it = std::partition(info.begin() + start, info.begin() + end,
                                       [dim, pmid](const BVHPrimitiveInfo& pi) { return pi.centroid[dim] < pmid; });
        mid = int(it - info.begin());
    }
    if (mid == start || mid == end) {
        mid = (start + end) / 2;
        std::nth_element(info.begin() + start, info.begin() + mid, info.begin() + end,
                         [dim](const BVHPrimitiveInfo& a, const BVHPrimitiveInfo& b) {
                             return a.centroid[dim] < b.centroid[dim];
                         });
    }
    node->children[0] = recursiveBuild(info, start, mid, level + 1);
    node->children[1] = recursiveBuild(info, mid, end, level + 1);
    return node;
}

static void flatten(const BVHBuildNode& from, std::size_t to, Bvh& bvh) {
    bvh.nodes[to].box = from.bounds;
    if (!from.children[0]) {
        bvh.nodes[to].first = std::uint32_t(bvh.surfaces.size());
        bvh.nodes[to].count = std::uint32_t(from.primitives.size());
        for (auto p : from.primitives) bvh.surfaces.push_back(p);
        return;
    }
    const std::size_t pair = bvh.nodes.size();
    bvh.nodes[to].first = std::uint32_t(pair);
    bvh.nodes.resize(pair + 2);
    flatten(*from.children[0], pair, bvh);
    flatten(*from.children[1], pair + 1, bvh);
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (surfaces.empty()) return bvh;
    std::vector<BVHPrimitiveInfo> info;
    for (auto s : surfaces) info.push_back({s, s->bounds(), s->bounds().center()});
    const auto root = recursiveBuild(info, 0, int(info.size()), 1);
    bvh.nodes.resize(1);
    flatten(*root, 0, bvh);
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> closest;
    const Surface* hitSurface = nullptr;
    if (bvh.nodes.empty()) return closest;
    std::pair<std::uint32_t, float> nodesToVisit[2 * k_max_bvh_levels];
    int toVisitOffset = 0;
    if (auto root = bvh.nodes[0].box.hit(ray)) nodesToVisit[toVisitOffset++] = {0U, root->enter};

    while (toVisitOffset > 0) {
        const auto [index, enter] = nodesToVisit[--toVisitOffset];
        if (closest && enter > closest->distance) continue;
        const BvhNode& node = bvh.nodes[index];
        if (node.count > 0) {
            for (std::uint32_t i = 0; i < node.count; ++i) {
                const Surface* s = bvh.surfaces[node.first + i];
                auto isect = s->hit(ray);
                if (!isect) continue;
                bool replace = !closest;
                if (closest) {
                    if (isect->distance < closest->distance) replace = true;
                    if (isect->distance == closest->distance) replace = s->order() < hitSurface->order();
                }
                if (replace) {
                    closest = isect;
                    hitSurface = s;
                }
            }
        } else {
            std::uint32_t c[2] = {node.first, node.first + 1};
            std::optional<Interval> t[2] = {bvh.nodes[c[0]].box.hit(ray), bvh.nodes[c[1]].box.hit(ray)};
            const int nearChild = t[0] && t[1] && t[1]->enter < t[0]->enter ? 1 : 0;
            for (int k : {1 - nearChild, nearChild})  // the near one last: it is popped first
                if (t[k]) nodesToVisit[toVisitOffset++] = {c[k], t[k]->enter};
        }
    }
    return closest;
}

static bool intersectP(const Bvh& bvh, std::size_t index, const Ray& ray, float tMax) {
    const BvhNode& node = bvh.nodes[index];
    auto range = node.box.hit(ray);
    if (!range.has_value() || range->enter > tMax) return false;
    if (node.is_leaf()) {
        const auto begin = bvh.surfaces.begin() + node.first;
        return std::any_of(begin, begin + node.count, [&](const Surface* s) {
            auto isect = s->hit(ray);
            return isect.has_value() && isect->distance < tMax;
        });
    }
    return intersectP(bvh, node.first, ray, tMax) || intersectP(bvh, node.first + 1, ray, tMax);
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    if (bvh.nodes.empty()) return false;
    return intersectP(bvh, 0, ray, distance);
}

}  // namespace raysteps
