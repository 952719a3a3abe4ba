#include "wide/search.hpp"

#include <bit>
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

/// What waits to be visited, the nearest on top, each with where the ray enters it.
class Stack {
public:
    /// Puts it below those of the entries from `bottom` on that are nearer.
    void push_in_order(Reference to, float enter, std::size_t bottom) {
        std::size_t at = size_++;
        for (; at > bottom && entries_[at - 1].enter < enter; --at) {
            entries_[at] = entries_[at - 1];
        }
        entries_[at] = {to, enter};
    }

    /// Takes the nearest one off that begins before the limit; false where there is none.
    bool pop(float limit, Reference& to) {
        while (size_ > 0) {
            const Entry& entry = entries_[--size_];
            if (entry.enter <= limit) {
                to = entry.to;
                return true;
            }
        }
        return false;
    }

    [[nodiscard]] std::size_t size() const { return size_; }

private:
    struct Entry {
        Reference to;
        float enter;
    };
    std::array<Entry, k_lanes* static_cast<std::size_t>(k_max_levels)> entries_;
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

/// The nearest of what was hit; all else goes onto the stack. Mostly there is nothing else, and nothing to compare.
HWY_INLINE Reference nearest_hit(const Node& node, const Lanes& enters, std::uint32_t hit, Stack& stack) {
    auto nearest = static_cast<std::size_t>(std::countr_zero(hit));
    const std::size_t bottom = stack.size();
    for (hit &= hit - 1; hit != 0; hit &= hit - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(hit));
        const bool nearer = enters[lane] < enters[nearest];
        const std::size_t farther = nearer ? nearest : lane;
        nearest = nearer ? lane : nearest;
        stack.push_in_order(node.to[farther], enters[farther], bottom);
    }
    return node.to[nearest];
}

/// Calls leaf(reference) for what the ray may meet before limit(), near boxes first.
template <class Leaf, class Limit>
HWY_INLINE void walk(const Tree& tree, const BoxRay& ray, Counts& counts, const Leaf& leaf, const Limit& limit) {
    Stack stack;
    Reference to(Kind::node, 0, 0);
    do {
        while (to.kind() == Kind::node) {
            const Node& node = tree.nodes[to.first()];
            counts.boxes += node.count;
            HWY_ALIGN Lanes enters;
            const std::uint32_t hit = boxes_hit(node, ray, limit(), enters);
            if (hit == 0) {
                break;
            }
            to = nearest_hit(node, enters, hit, stack);
        }
        if (to.kind() != Kind::node) {
            leaf(to);
        }
    } while (stack.pop(limit(), to));
}

/// Calls leaf(reference) for `to`, and then for what the ray may meet before the limit in any order, until it returns
/// true. Returns where that was, or the root.
template <class Leaf>
HWY_INLINE Reference walk_any(const Tree& tree, const BoxRay& ray, Counts& counts, float limit, Reference to,
                              const Leaf& leaf) {
    const Reference root(Kind::node, 0, 0);
    std::array<Reference, k_lanes*(static_cast<std::size_t>(k_max_levels) + 2)> stack;
    std::size_t size = 0;
    if (to != root) {
        stack[size++] = root;
    }
    for (;;) {
        if (to.kind() == Kind::node) {
            const Node& node = tree.nodes[to.first()];
            counts.boxes += node.count;
            if (const std::uint32_t hit = push_hit(node, ray, limit, &stack[size]); hit != 0) {
                to = node.to[static_cast<std::size_t>(std::bit_width(hit)) - 1];  // sooner known than from the stack
                size += static_cast<std::size_t>(std::popcount(hit)) - 1;
                continue;
            }
        } else if (leaf(to)) {
            return to;
        }
        if (size == 0) {
            return root;
        }
        to = stack[--size];
    }
}

/// Calls certain(place, least, most) and doubtful(place) for what may be hit before the limit, until one returns true.
template <class Block, class Doubtful, class Certain>
HWY_INLINE bool ask_blocks(const std::vector<Block>& blocks, Reference to, const SurfaceRay& ray, float limit,
                           Counts& counts, const Doubtful& doubtful, const Certain& certain) {
    for (std::uint32_t i = to.first(); i < to.first() + to.count(); ++i) {
        const Block& block = blocks[i];
        counts.surfaces += block.surfaces.count;
        Verdicts verdicts;
        ask_block(block, ray, limit, verdicts);
        for (std::uint32_t left = verdicts.sure; left != 0; left &= left - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(left));
            if (certain(block.surfaces.first + lane, verdicts.least[lane], verdicts.most[lane])) {
                return true;
            }
        }
        for (std::uint32_t left = verdicts.doubtful; left != 0; left &= left - 1) {
            if (doubtful(block.surfaces.first + static_cast<std::size_t>(std::countr_zero(left)))) {
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
        if (doubtful(i)) {
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
    const auto doubtful = [&](std::size_t at) {
        found.ask(*tree.surfaces[at]);
        return false;
    };
    const auto certain = [&](std::size_t at, float least, float most) {
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
    std::optional<HitRecord> hit = !careful && found.has_one() ? found.ask_one() : found.ask_all();
    failed = found.failed(hit);
    return hit;
}

std::optional<HitRecord> closest(const Tree& tree, const Ray& ray) {
    bool failed = false;
    std::optional<HitRecord> hit = search<false>(tree, ray, failed);
    if (failed) {
        hit = search<true>(tree, ray, failed);
    }
    return hit;
}

bool any(const Tree& tree, const Ray& ray, float distance, std::uint32_t& hint) {
    Counts counts;
    const SurfaceRay surface_ray(ray);
    const auto doubtful = [&](std::size_t at) {
        const std::optional<HitRecord> hit = tree.surfaces[at]->hit(ray);
        return hit && hit->distance < distance;
    };
    const auto certain = [](std::size_t, float, float) { return true; };
    const auto leaf = [&](Reference to)
                          HWY_ATTR { return ask_leaf(tree, to, surface_ray, distance, counts, doubtful, certain); };
    hint = walk_any(tree, BoxRay(ray), counts, distance, Reference(hint), leaf).bits();
    return hint != 0;
}

}  // namespace
}  // namespace raysteps::wide::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raysteps::wide {

HWY_EXPORT(closest);
HWY_EXPORT(any);

Search best_search() {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return {.closest_hit = &HWY_DYNAMIC_DISPATCH(closest), .occluded = &HWY_DYNAMIC_DISPATCH(any)};
}

}  // namespace raysteps::wide
#endif
