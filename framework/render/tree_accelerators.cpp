// The trees of steps 06 and 09 as the renderer asks them.
#include <algorithm>
#include <vector>

#include "render/accelerators.hpp"
#include "steps/06-octree/octree.hpp"
#include "steps/09-bvh/bvh.hpp"

namespace raysteps {
namespace {

using Iterator = SurfaceList::const_iterator;

bool holds(Iterator first, Iterator last, const Surface* wanted) {
    return wanted != nullptr && std::find(first, last, wanted) != last;
}

class OctreeAccelerator final : public Accelerator {
public:
    explicit OctreeAccelerator(const SurfaceList& surfaces) : root_(build_octree(surfaces)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return closest_hit_in_octree(root_, ray);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return occluded_in_octree(root_, ray, distance);
    }
    [[nodiscard]] AcceleratorStats size() const override { return size_below(root_); }

    void visit_nodes(const Surface* wanted, const NodeVisitor& visit) const override {
        visit_below(root_, 0, wanted, visit);
    }

private:
    static void visit_below(const Node& node, int level, const Surface* wanted, const NodeVisitor& visit) {
        visit({.box = node.box,
               .level = level,
               .listed = node.surfaces.size(),
               .lists_wanted = holds(node.surfaces.begin(), node.surfaces.end(), wanted)});
        for (const Node& child : node.children) {
            visit_below(child, level + 1, wanted, visit);
        }
    }

    static AcceleratorStats size_below(const Node& node) {
        AcceleratorStats sum{.boxes = 1,
                             .references = node.surfaces.size(),
                             .bytes = sizeof(Node) + node.surfaces.size() * sizeof(const Surface*)};
        for (const Node& child : node.children) {
            const AcceleratorStats below = size_below(child);
            sum.boxes += below.boxes;
            sum.references += below.references;
            sum.bytes += below.bytes;
        }
        return sum;
    }

    Node root_;
};

class BvhAccelerator final : public Accelerator {
public:
    explicit BvhAccelerator(const SurfaceList& surfaces) : bvh_(build_bvh(surfaces)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return closest_hit_in_bvh(bvh_, ray);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return occluded_in_bvh(bvh_, ray, distance);
    }

    [[nodiscard]] AcceleratorStats size() const override {
        return {.boxes = bvh_.nodes.size(),
                .references = bvh_.surfaces.size(),
                .bytes = bvh_.nodes.size() * sizeof(BvhNode) + bvh_.surfaces.size() * sizeof(const Surface*)};
    }

    /// Node by node and not from the root on, as a student's tree may point anywhere, even in a circle.
    void visit_nodes(const Surface* wanted, const NodeVisitor& visit) const override {
        std::vector<int> levels(bvh_.nodes.size(), 0);
        for (std::size_t i = 0; i < bvh_.nodes.size(); ++i) {
            const BvhNode& node = bvh_.nodes[i];
            const std::size_t child = node.first;
            if (!node.is_leaf() && child > i && child + 1 < levels.size()) {
                levels[child] = levels[child + 1] = levels[i] + 1;
            }
            const std::size_t first = node.is_leaf() ? std::min(child, bvh_.surfaces.size()) : 0;
            const std::size_t count = std::min<std::size_t>(node.count, bvh_.surfaces.size() - first);
            const auto begin = bvh_.surfaces.begin() + static_cast<std::ptrdiff_t>(first);
            visit({.box = node.box,
                   .level = levels[i],
                   .listed = count,
                   .lists_wanted = holds(begin, begin + static_cast<std::ptrdiff_t>(count), wanted)});
        }
    }

private:
    Bvh bvh_;
};

}  // namespace

std::unique_ptr<Accelerator> octree_accelerator(const SurfaceList& surfaces) {
    return std::make_unique<OctreeAccelerator>(surfaces);
}

std::unique_ptr<Accelerator> bvh_accelerator(const SurfaceList& surfaces) {
    return std::make_unique<BvhAccelerator>(surfaces);
}

}  // namespace raysteps
