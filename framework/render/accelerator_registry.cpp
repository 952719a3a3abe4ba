#include "render/accelerator_registry.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "render/accelerators.hpp"

namespace raysteps {
namespace {

constexpr bool k_has_octree = RAYSTEPS_HAS_06;  // CMake knows the steps
constexpr bool k_has_bvh = RAYSTEPS_HAS_09;

constexpr std::string_view k_no_octree =
    "this course has no step 06, which builds the octree; --accel none draws the same picture";
constexpr std::string_view k_no_bvh =
    "this course has no step 09, which builds the bounding volumes; --accel none draws the same picture";
constexpr std::string_view k_no_paper_grid =
    k_has_octree
        ? "only the whole kit has the paper's boxes; --accel octree draws the same picture with step 06's own tree"
        : "only the whole kit has the paper's boxes; --accel none draws the same picture";
constexpr std::string_view k_no_wide_trees =
    "only the whole kit's reference has wide trees (--impl reference), where the library Highway is installed "
    "(Debian: libhwy-dev); --accel none draws the same picture";

using Table = std::array<AcceleratorEntry, 6>;

/// In the order of Acceleration.
Table& table() {
    static Table entries{{
        {.kind = Acceleration::none, .name = "none", .step = 1, .make = linear_accelerator, .unavailable_reason = {}},
        {.kind = Acceleration::boxes,
         .name = "boxes",
         .step = 6,
         .make = paper_grid(),
         .unavailable_reason = k_no_paper_grid},
        {.kind = Acceleration::octree,
         .name = "octree",
         .step = 6,
         .make = k_has_octree ? octree_accelerator : nullptr,
         .unavailable_reason = k_no_octree},
        {.kind = Acceleration::bvh,
         .name = "bvh",
         .step = 9,
         .make = k_has_bvh ? bvh_accelerator : nullptr,
         .unavailable_reason = k_no_bvh},
        {.kind = Acceleration::wide,
         .name = "wide",
         .step = 9,
         .make = nullptr,  // registered by wide/register.cpp, as the next one
         .unavailable_reason = k_no_wide_trees},
        {.kind = Acceleration::wide_octree,
         .name = "wide-octree",
         .step = 6,
         .make = nullptr,
         .unavailable_reason = k_no_wide_trees},
    }};
    return entries;
}

AcceleratorEntry& entry_of(Acceleration kind) { return table().at(static_cast<std::size_t>(kind)); }

}  // namespace

std::span<const AcceleratorEntry> accelerator_registry() { return table(); }

const AcceleratorEntry& accelerator_entry(Acceleration kind) { return entry_of(kind); }

const AcceleratorEntry* find_accelerator(std::string_view name) {
    const Table& entries = table();
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
    return found != entries.end() ? &*found : nullptr;
}

bool register_accelerator(Acceleration kind, AcceleratorMaker make) {
    entry_of(kind).make = make;
    return true;
}

Acceleration default_accelerator(int step) {
    if (step >= 9 && k_has_bvh) {
        return Acceleration::bvh;
    }
    return step >= 6 && k_has_octree ? Acceleration::octree : Acceleration::none;
}

std::unique_ptr<Accelerator> make_accelerator(Acceleration kind, const SurfaceList& surfaces) {
    const AcceleratorEntry& entry = entry_of(kind);
    if (entry.make == nullptr) {
        throw std::invalid_argument(std::string(entry.unavailable_reason));
    }
    return entry.make(surfaces);
}

}  // namespace raysteps
