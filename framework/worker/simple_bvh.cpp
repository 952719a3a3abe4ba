#include "worker/simple_bvh.hpp"

#include <algorithm>
#include <unordered_map>

#include "worker/protocol.hpp"

namespace raysteps {
namespace {

constexpr std::ptrdiff_t k_leaf_size = 3;

using Place = SurfaceList::iterator;

Box box_around(Place begin, Place end) {
    Box box;
    for (auto at = begin; at != end; ++at) {
        box.extend((*at)->bounds());
    }
    return box;
}

/// Fills in node number `at`, and what is below it. The first child holds what comes later in the list, so that the
/// first leaf is not the one at the start of the list: who mixes these up is seen.
void halve(Bvh& bvh, std::size_t at, Place begin, Place end, int axis, float padding) {
    const Box box = box_around(begin, end);
    const auto first_surface = static_cast<std::uint32_t>(begin - bvh.surfaces.begin());
    bvh.nodes[at] = {
        .box = box.padded(padding), .first = first_surface, .count = static_cast<std::uint32_t>(end - begin)};
    if (end - begin <= k_leaf_size) {
        return;
    }
    std::stable_sort(begin, end, [axis](const Surface* a, const Surface* b) {
        const Box left = a->bounds();
        const Box right = b->bounds();
        return left.min[axis] + left.max[axis] < right.min[axis] + right.max[axis];
    });
    const std::size_t first = bvh.nodes.size();
    bvh.nodes[at].first = static_cast<std::uint32_t>(first);
    bvh.nodes[at].count = 0;
    bvh.nodes.resize(first + 2);
    const auto middle = begin + (end - begin) / 2;
    halve(bvh, first, middle, end, (axis + 1) % 3, padding);
    halve(bvh, first + 1, begin, middle, (axis + 1) % 3, padding);
}

}  // namespace

Bvh simple_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (surfaces.empty()) {
        return bvh;
    }
    bvh.surfaces.assign(surfaces.rbegin(), surfaces.rend());
    const Box all = box_around(bvh.surfaces.begin(), bvh.surfaces.end());
    const glm::vec3 size = all.max - all.min;
    const float padding = 1e-4F * std::max({size.x, size.y, size.z, 1.0F});
    bvh.nodes.resize(1);
    halve(bvh, 0, bvh.surfaces.begin(), bvh.surfaces.end(), 0, padding);
    return bvh;
}

void write_bvh(TokenWriter& answer, const Bvh& bvh, const SurfaceList& surfaces) {
    if (bvh.nodes.size() > k_max_nodes || bvh.surfaces.size() > k_max_entries) {
        answer.word("large").word(bvh.nodes.size() > k_max_nodes ? "nodes" : "surfaces");
        return;
    }
    std::unordered_map<const Surface*, int> numbers;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        numbers[surfaces[i]] = static_cast<int>(i);
    }
    answer.word("bvh").whole(static_cast<long long>(bvh.nodes.size()));
    for (const BvhNode& node : bvh.nodes) {
        write_box(answer, node.box);
        answer.whole(node.first).whole(node.count);
    }
    answer.whole(static_cast<long long>(bvh.surfaces.size()));
    for (const Surface* surface : bvh.surfaces) {
        const auto found = numbers.find(surface);
        answer.whole(found == numbers.end() ? -1 : found->second);
    }
}

}  // namespace raysteps
