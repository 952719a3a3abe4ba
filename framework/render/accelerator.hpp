#pragma once
// The structures that the renderer can look for hits with. All give the same hits.
#include <memory>
#include <optional>

#include "core/hit_record.hpp"
#include "core/scene.hpp"

namespace raysteps {

enum class Acceleration {
    none,    ///< every ray against every surface: step 02
    boxes,   ///< the paper's three levels: a main box, 8 boxes, 64 boxes
    octree,  ///< the tree of step 06
};

class Accelerator {
public:
    virtual ~Accelerator() = default;

    /// The nearest hit with distance > 0, or nothing. Safe to call from many threads at once.
    [[nodiscard]] virtual std::optional<HitRecord> closest_hit(const Ray& ray) const = 0;

protected:
    Accelerator() = default;
    Accelerator(const Accelerator&) = default;
    Accelerator& operator=(const Accelerator&) = default;
};

/// Builds the structure. The surfaces must outlive it.
[[nodiscard]] std::unique_ptr<Accelerator> make_accelerator(Acceleration kind, const SurfaceList& surfaces);

}  // namespace raysteps
