#pragma once
// What is measured.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/accelerator.hpp"

namespace raysteps::bench {

struct Structure {
    std::string name;
    bool slow = false;     ///< gets a sample of the rays and makes no whole picture
    bool foreign = false;  ///< somebody else's arithmetic: its hits are near the kit's, not the same
    bool (*can_hold)(const SurfaceList&) = nullptr;  ///< where it is not for every scene
    std::function<std::unique_ptr<Accelerator>(const SurfaceList&)> make;
};

/// Whether the structure is for such a scene.
[[nodiscard]] inline bool holds(const Structure& structure, const SurfaceList& surfaces) {
    return structure.can_hold == nullptr || structure.can_hold(surfaces);
}

/// All that this program has.
[[nodiscard]] const std::vector<Structure>& all_structures();

/// Those of the names, in the order of all; all when there are no names. Throws UsageError for an unknown one.
[[nodiscard]] std::vector<Structure> chosen_structures(const std::vector<std::string>& names);

/// JSON, schema raysteps/bench-structures/v1: their names, and which are slow or foreign.
[[nodiscard]] std::string list_structures(const std::vector<std::string>& words);

/// Embree's version, or nothing where it is missing.
[[nodiscard]] std::string embree_version();

}  // namespace raysteps::bench
