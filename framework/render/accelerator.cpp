#include "render/accelerator.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "render/linear_accelerator.hpp"
#include "render/paper_grid.hpp"
#include "steps/06-octree/octree.hpp"
#include "steps/09-bvh/bvh.hpp"

namespace raysteps {
namespace {

using Place = SurfaceList::const_iterator;

bool holds(Place first, Place last, const Surface* wanted) {
    return wanted != nullptr && std::find(first, last, wanted) != last;
}

class Octree final : public Accelerator {
public:
    explicit Octree(const SurfaceList& surfaces) : root_(build_octree(surfaces)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return closest_hit_in(root_, ray);
    }

    [[nodiscard]] bool any_hit(const Ray& ray, float distance) const override {
        return any_hit_in(root_, ray, distance);
    }
    [[nodiscard]] AcceleratorStats size() const override { return size_below(root_); }

    void visit_nodes(const Surface* wanted, const NodeVisitor& visit) const override {
        visit_below(root_, 0, wanted, visit);
    }

private:
    static void visit_below(const Node& node, int level, const Surface* wanted, const NodeVisitor& visit) {
        visit({node.box, level, node.surfaces.size(), holds(node.surfaces.begin(), node.surfaces.end(), wanted)});
        for (const Node& child : node.children) {
            visit_below(child, level + 1, wanted, visit);
        }
    }

    static AcceleratorStats size_below(const Node& node) {
        AcceleratorStats sum{1, node.surfaces.size(), sizeof(Node) + node.surfaces.size() * sizeof(const Surface*)};
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

    [[nodiscard]] bool any_hit(const Ray& ray, float distance) const override {
        return any_hit_in_bvh(bvh_, ray, distance);
    }

    [[nodiscard]] AcceleratorStats size() const override {
        return {bvh_.nodes.size(), bvh_.surfaces.size(),
                bvh_.nodes.size() * sizeof(BvhNode) + bvh_.surfaces.size() * sizeof(const Surface*)};
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
            const Place begin = bvh_.surfaces.begin() + static_cast<std::ptrdiff_t>(first);
            visit({node.box, levels[i], count, holds(begin, begin + static_cast<std::ptrdiff_t>(count), wanted)});
        }
    }

private:
    Bvh bvh_;
};

std::map<Acceleration, AcceleratorMaker>& offered() {
    static std::map<Acceleration, AcceleratorMaker> makers;
    return makers;
}

}  // namespace

bool offer_accelerator(Acceleration kind, AcceleratorMaker make) {
    offered()[kind] = make;
    return true;
}

bool has_accelerator(Acceleration kind) {
    switch (kind) {
        case Acceleration::boxes:
            return paper_grid() != nullptr;
        case Acceleration::wide:
        case Acceleration::wide_octree:
            return offered().contains(kind);
        default:
            return true;
    }
}

std::string why_without(Acceleration kind) {
    if (kind == Acceleration::boxes) {
        return "only the whole kit has the paper's boxes; --accel octree draws the same picture with step 06's own tree";
    }
    return "only the reference has wide trees (--impl reference), and only where the library Highway is installed "
           "(Debian: libhwy-dev); --accel bvh draws the same picture";
}

std::vector<Acceleration> available(std::vector<Acceleration> kinds) {
    std::erase_if(kinds, [](Acceleration kind) { return !has_accelerator(kind); });
    return kinds;
}

std::unique_ptr<Accelerator> make_accelerator(Acceleration kind, const SurfaceList& surfaces) {
    if (!has_accelerator(kind)) {
        throw std::invalid_argument(why_without(kind));
    }
    switch (kind) {
        case Acceleration::none:
            return linear_accelerator(surfaces);
        case Acceleration::boxes:
            return paper_grid()(surfaces);
        case Acceleration::octree:
            return std::make_unique<Octree>(surfaces);
        case Acceleration::bvh:
            return std::make_unique<BvhAccelerator>(surfaces);
        case Acceleration::wide:
        case Acceleration::wide_octree:
            return offered()[kind](surfaces);
    }
    return nullptr;
}

}  // namespace raysteps
