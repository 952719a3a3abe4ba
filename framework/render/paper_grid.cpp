// The paper's own acceleration: a main box is split in eight, and each of these again, into 64 boxes. A ray
// tests the surfaces of all small boxes that it hits, each surface once, in the order of the scene.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/rounding.hpp"
#include "render/accelerators.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "steps/06-octree/octree.hpp"

namespace raysteps {
namespace {

std::vector<std::uint64_t> members_of(const Box& box, const SurfaceList& surfaces) {
    std::vector<std::uint64_t> members((surfaces.size() + 63) / 64, 0);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (surfaces[i]->overlaps(box)) {
            members[i / 64] |= std::uint64_t{1} << (i % 64);
        }
    }
    return members;
}

std::uint64_t count_members(const std::vector<std::uint64_t>& members) {
    std::uint64_t count = 0;
    for (const std::uint64_t word : members) {
        count += static_cast<std::uint64_t>(std::popcount(word));
    }
    return count;
}

/// The surfaces whose bits are set, in the order of the scene.
void append_members(const std::vector<std::uint64_t>& members, const SurfaceList& surfaces, SurfaceList& out) {
    for (std::size_t word = 0; word < members.size(); ++word) {
        for (std::uint64_t rest = members[word]; rest != 0; rest &= rest - 1) {
            out.push_back(surfaces[64 * word + static_cast<std::size_t>(std::countr_zero(rest))]);
        }
    }
}

/// Whether one of the members that were not tested yet is hit nearer than `distance`; marks them as tested.
bool hits_untested(const std::vector<std::uint64_t>& members, std::vector<std::uint64_t>& tested,
                   const SurfaceList& surfaces, const Ray& ray, float distance) {
    for (std::size_t word = 0; word < members.size(); ++word) {
        for (std::uint64_t rest = members[word] & ~tested[word]; rest != 0; rest &= rest - 1) {
            const Surface* surface = surfaces[64 * word + static_cast<std::size_t>(std::countr_zero(rest))];
            const std::optional<HitRecord> hit = surface->hit(ray);
            if (hit && hit->distance < distance) {
                return true;
            }
        }
        tested[word] |= members[word];
    }
    return false;
}

class PaperGrid final : public Accelerator {
public:
    explicit PaperGrid(SurfaceList surfaces);

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override;
    [[nodiscard]] AcceleratorStats size() const override;
    void visit_nodes(const Surface* wanted, const NodeVisitor& visit) const override;

private:
    /// A small box and its intersect list: bit i of word w stands for surface 64 w + i.
    struct Small {
        Box box;
        std::vector<std::uint64_t> members;
    };
    struct Middle {
        Box box;
        std::array<Small, 8> small;
    };

    SurfaceList surfaces_;
    Box main_;
    std::array<Middle, 8> middle_;
};

PaperGrid::PaperGrid(SurfaceList surfaces) : surfaces_(std::move(surfaces)) {
    if (surfaces_.empty()) {
        return;
    }
    const Box all = bounds_of(surfaces_);
    const float padding = padding_within(all);
    main_ = all.padded(padding);
    const std::array<Box, 8> middle_boxes = split(main_);
    for (std::size_t m = 0; m < 8; ++m) {
        middle_[m].box = middle_boxes[m].padded(padding);
        const std::array<Box, 8> small_boxes = split(middle_boxes[m]);
        for (std::size_t s = 0; s < 8; ++s) {
            const Box box = small_boxes[s].padded(padding);
            middle_[m].small[s] = {box, members_of(box, surfaces_)};
        }
    }
}

std::optional<HitRecord> PaperGrid::closest_hit(const Ray& ray) const {
    if (surfaces_.empty() || !main_.hit(ray)) {
        return std::nullopt;
    }
    std::vector<std::uint64_t> candidates((surfaces_.size() + 63) / 64, 0);
    for (const Middle& middle : middle_) {
        if (!middle.box.hit(ray)) {
            continue;
        }
        for (const Small& small : middle.small) {
            if (small.box.hit(ray)) {
                for (std::size_t word = 0; word < candidates.size(); ++word) {
                    candidates[word] |= small.members[word];
                }
            }
        }
    }
    SurfaceList list;
    append_members(candidates, surfaces_, list);
    return raysteps::closest_hit(list, ray);
}

bool PaperGrid::occluded(const Ray& ray, float distance) const {
    if (surfaces_.empty() || !main_.hit(ray)) {
        return false;
    }
    std::vector<std::uint64_t> tested((surfaces_.size() + 63) / 64, 0);
    const auto has_hit = [&](const Small& small) {
        return small.box.hit(ray) && hits_untested(small.members, tested, surfaces_, ray, distance);
    };
    return std::any_of(middle_.begin(), middle_.end(), [&](const Middle& middle) {
        return middle.box.hit(ray) && std::any_of(middle.small.begin(), middle.small.end(), has_hit);
    });
}

AcceleratorStats PaperGrid::size() const {
    AcceleratorStats sum{.boxes = 1, .references = 0, .bytes = sizeof middle_ + sizeof main_};
    for (const Middle& middle : middle_) {
        sum.boxes += 1 + middle.small.size();
        for (const Small& small : middle.small) {
            sum.bytes += small.members.size() * sizeof(std::uint64_t);
            sum.references += count_members(small.members);
        }
    }
    return sum;
}

void PaperGrid::visit_nodes(const Surface* wanted, const NodeVisitor& visit) const {
    if (surfaces_.empty()) {
        return;
    }
    const auto place = std::find(surfaces_.begin(), surfaces_.end(), wanted);
    const auto bit = static_cast<std::size_t>(place - surfaces_.begin());
    visit({.box = main_, .level = 0});
    for (const Middle& middle : middle_) {
        visit({.box = middle.box, .level = 1});
        for (const Small& small : middle.small) {
            const bool member = place != surfaces_.end() && ((small.members[bit / 64] >> (bit % 64)) & 1U) != 0U;
            visit({.box = small.box, .level = 2, .listed = count_members(small.members), .lists_wanted = member});
        }
    }
}

}  // namespace

AcceleratorMaker paper_grid() {
    return [](const SurfaceList& surfaces) -> std::unique_ptr<Accelerator> {
        return std::make_unique<PaperGrid>(surfaces);
    };
}

}  // namespace raysteps
