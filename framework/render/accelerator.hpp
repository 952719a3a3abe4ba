#pragma once
// The structures that the renderer can look for hits with. All give the same hits.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "core/scene_query.hpp"

namespace raysteps {

enum class Acceleration {
    none,    ///< every ray against every surface: step 02
    boxes,   ///< the paper's three levels: a main box, 8 boxes, 64 boxes
    octree,  ///< the tree of step 06
    bvh,     ///< the tree of step 09
    wide,         ///< the same tree, eight boxes or surfaces at a time
    wide_octree,  ///< the tree of step 06, eight at a time
};

/// What a structure costs before the first ray.
struct StructureSize {
    std::uint64_t boxes = 0;
    std::uint64_t references = 0;  ///< entries in the lists of its boxes; a surface may be in several
    std::uint64_t bytes = 0;       ///< of boxes and lists, without the surfaces themselves
};

/// A box of a structure, as it is shown to whoever looks at the structure itself.
struct BoxPlace {
    const Box& box;             ///< the very one that rays are tested against
    int level = 0;              ///< 0: the root
    std::uint64_t listed = 0;   ///< surfaces in its own list
    bool lists_wanted = false;  ///< whether the surface that was asked for is one of them
};

using BoxVisitor = std::function<void(const BoxPlace& place)>;

class Accelerator : public SceneQuery {
public:
    [[nodiscard]] virtual StructureSize size() const { return {}; }

    /// Shows every box, each before those within it. `wanted` may be null.
    virtual void visit_boxes(const Surface* /*wanted*/, const BoxVisitor& /*visit*/) const {}
};

using AcceleratorMaker = std::unique_ptr<Accelerator> (*)(const SurfaceList& surfaces);

/// A program that is linked with the wide trees offers them here, before main begins. Always true.
bool offer_accelerator(Acceleration kind, AcceleratorMaker make);

/// Whether this program has the structure.
[[nodiscard]] bool has_accelerator(Acceleration kind);

/// What to say where it has not, and what to take instead.
[[nodiscard]] std::string why_without(Acceleration kind);

/// Of these structures, those that this program has.
[[nodiscard]] std::vector<Acceleration> available(std::vector<Acceleration> kinds);

/// Builds the structure. The surfaces must outlive it. Throws std::invalid_argument for one that the program lacks.
[[nodiscard]] std::unique_ptr<Accelerator> make_accelerator(Acceleration kind, const SurfaceList& surfaces);

}  // namespace raysteps
