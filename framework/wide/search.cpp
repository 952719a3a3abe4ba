#include "wide/search.hpp"

#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "core/rounding.hpp"
#include "core/stats.hpp"
#include "wide/candidates.hpp"

// This file is compiled once for each set of instructions. Vectors without a fixed length are left out: they cannot be
// members of a struct.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wide/search.cpp"
#include <hwy/foreach_target.h>  // has to come before highway.h

#include <hwy/highway.h>

#include "wide/blocks-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace raysteps::wide::HWY_NAMESPACE {
namespace {

struct Open {
    Reference to;
    float enter;
};

/// Nodes that wait, the nearest on top.
class Stack {
public:
    void push(const Open& open) { entries_[size_++] = open; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    Open pop() { return entries_[--size_]; }

    /// Keeps the entries from `bottom` on in order, the nearest last.
    void push_in_order(const Open& open, std::size_t bottom) {
        std::size_t at = size_++;
        for (; at > bottom && entries_[at - 1].enter < open.enter; --at) {
            entries_[at] = entries_[at - 1];
        }
        entries_[at] = open;
    }
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    std::array<Open, k_lanes* static_cast<std::size_t>(k_max_levels)> entries_;
    std::size_t size_ = 0;
};

struct Counts {
    std::uint64_t boxes = 0;
    std::uint64_t surfaces = 0;

    ~Counts() {
        thread_stats().box_tests += boxes;
        thread_stats().surface_tests += surfaces;
    }
};

/// Calls leaf(reference) for what the ray may meet before limit(), near boxes first, until leaf returns true.
template <class Leaf, class Limit>
HWY_INLINE void walk(const Tree& tree, const BoxRay& ray, Counts& counts, const Leaf& leaf, const Limit& limit) {
    Stack stack;
    stack.push({Reference(Kind::node, 0, 0), 0.0F});
    while (!stack.empty()) {
        const Open open = stack.pop();
        if (open.enter * (1.0F - k_distance_slack) > limit()) {
            continue;
        }
        if (open.to.kind() != Kind::node) {
            if (leaf(open.to)) {
                return;
            }
            continue;
        }
        const Node& node = tree.nodes[open.to.first()];
        counts.boxes += node.count;
        HWY_ALIGN std::array<float, k_lanes> enters;
        const std::size_t bottom = stack.size();
        for (std::uint32_t hit = boxes_hit(node, ray, limit(), enters); hit != 0; hit &= hit - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(hit));
            stack.push_in_order({node.to[lane], enters[lane]}, bottom);
        }
    }
}

template <class Block, class Doubtful, class Certain>
HWY_INLINE bool ask_blocks(const std::vector<Block>& blocks, Reference to, const SurfaceRay& ray, float limit,
                           Counts& counts, const Doubtful& doubtful, const Certain& certain) {
    for (std::uint32_t i = to.first(); i < to.first() + to.count(); ++i) {
        const Block& block = blocks[i];
        counts.surfaces += block.count;
        Verdicts verdicts;
        ask_block(block, ray, limit, verdicts);
        for (std::uint32_t left = verdicts.sure; left != 0; left &= left - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(left));
            if (certain(block.surface[lane], verdicts.least[lane], verdicts.most[lane])) {
                return true;
            }
        }
        for (std::uint32_t left = verdicts.doubtful; left != 0; left &= left - 1) {
            if (doubtful(block.surface[static_cast<std::size_t>(std::countr_zero(left))])) {
                return true;
            }
        }
    }
    return false;
}

/// All blocks of a reference, whatever their kind.
template <class Doubtful, class Certain>
HWY_INLINE bool ask_leaf(const Tree& tree, Reference to, const SurfaceRay& ray, float limit, Counts& counts,
                         const Doubtful& doubtful, const Certain& certain) {
    if (to.kind() == Kind::triangles) {
        return ask_blocks(tree.triangles, to, ray, limit, counts, doubtful, certain);
    }
    if (to.kind() == Kind::spheres) {
        return ask_blocks(tree.spheres, to, ray, limit, counts, doubtful, certain);
    }
    if (to.kind() == Kind::cones) {
        return ask_blocks(tree.cones, to, ray, limit, counts, doubtful, certain);
    }
    for (std::uint32_t i = to.first(); i < to.first() + to.count(); ++i) {
        if (doubtful(tree.others[i])) {
            return true;
        }
    }
    return false;
}

/// `careful`: every surface that may be hit is asked at once.
template <bool careful>
std::optional<HitRecord> search(const Tree& tree, const Ray& ray, bool& failed) {
    Candidates found(ray);
    Counts counts;
    const SurfaceRay surface_ray(ray);
    const auto doubtful = [&](std::uint32_t at) {
        found.ask(*tree.surfaces[at]);
        return false;
    };
    const auto certain = [&](std::uint32_t at, float least, float most) {
        if constexpr (careful) {
            found.ask(*tree.surfaces[at]);
        } else {
            found.add({tree.surfaces[at], least, most});
        }
        return false;
    };
    const auto leaf = [&](Reference to) HWY_ATTR {
        return ask_leaf(tree, to, surface_ray, found.limit(), counts, doubtful, certain);
    };
    walk(tree, BoxRay(ray), counts, leaf, [&] { return found.limit(); });
    const std::optional<HitRecord>& hit = found.settle();
    failed = found.failed();
    return hit;
}

std::optional<HitRecord> closest(const Tree& tree, const Ray& ray) {
    bool failed = false;
    const std::optional<HitRecord> hit = search<false>(tree, ray, failed);
    return failed ? search<true>(tree, ray, failed) : hit;
}

bool any(const Tree& tree, const Ray& ray, float distance) {
    bool found = false;
    Counts counts;
    const SurfaceRay surface_ray(ray);
    const auto doubtful = [&](std::uint32_t at) {
        const std::optional<HitRecord> hit = tree.surfaces[at]->hit(ray);
        found = hit && hit->distance < distance;
        return found;
    };
    const auto certain = [&](std::uint32_t at, float, float most) {
        found = most < distance;
        return found || doubtful(at);
    };
    const auto leaf = [&](Reference to)
                          HWY_ATTR { return ask_leaf(tree, to, surface_ray, distance, counts, doubtful, certain); };
    walk(tree, BoxRay(ray), counts, leaf, [&] { return distance; });
    return found;
}

const char* target() { return hwy::TargetName(HWY_TARGET); }

}  // namespace
}  // namespace raysteps::wide::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raysteps::wide {

HWY_EXPORT(closest);
HWY_EXPORT(any);
HWY_EXPORT(target);

std::optional<HitRecord> closest_hit(const Tree& tree, const Ray& ray) {
    return HWY_DYNAMIC_DISPATCH(closest)(tree, ray);
}

bool occluded(const Tree& tree, const Ray& ray, float distance) {
    return HWY_DYNAMIC_DISPATCH(any)(tree, ray, distance);
}

const char* instructions() { return HWY_DYNAMIC_DISPATCH(target)(); }

}  // namespace raysteps::wide
#endif
