#pragma once
// A tree of boxes with up to eight children each, laid out so that one instruction works on eight boxes, triangles or
// spheres at once. It is made from the tree that a step built, and answers what that step's own search would answer.
#include <array>
#include <cstdint>
#include <vector>

#include "core/box.hpp"
#include "core/surface.hpp"

namespace raysteps::wide {

inline constexpr std::size_t k_lanes = 8;
using Lanes = std::array<float, k_lanes>;

/// What an entry of a node leads to.
enum class Kind : std::uint32_t { node, triangles, spheres, cones, others };

/// A node, or a run of blocks of surfaces of one kind, in 32 bits: 3 for the kind, 5 for the count.
class Reference {
public:
    static constexpr std::uint32_t k_max_blocks = 31;
    static constexpr std::uint32_t k_max_first = (1U << 24U) - 1;

    Reference() = default;  ///< to nowhere in particular: a stack of many costs nothing
    /// first <= k_max_first, count <= k_max_blocks
    Reference(Kind kind, std::uint32_t first, std::uint32_t count)
        : bits_(static_cast<std::uint32_t>(kind) << 29U | count << 24U | first) {}

    [[nodiscard]] Kind kind() const { return static_cast<Kind>(bits_ >> 29U); }
    [[nodiscard]] std::uint32_t first() const { return bits_ & k_max_first; }
    [[nodiscard]] std::uint32_t count() const { return bits_ >> 24U & k_max_blocks; }

    /// The same as one number; 0: to the root.
    [[nodiscard]] std::uint32_t bits() const { return bits_; }
    explicit Reference(std::uint32_t bits) : bits_(bits) {}

    bool operator==(const Reference&) const = default;

private:
    std::uint32_t bits_;
};

/// Up to eight boxes, axis by axis. An empty place holds a box that no ray meets.
struct alignas(64) Node {
    std::array<Lanes, 6> walls;  ///< low x, y, z, then high x, y, z
    std::array<Reference, k_lanes> to;
    std::uint32_t count = 0;
};

/// The surfaces of a block, one after the other in Tree::surfaces.
struct SurfaceRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Eight triangles as a corner and the two edges that leave it, with what bounds their rounding errors.
struct alignas(32) TriangleBlock {
    std::array<Lanes, 3> corner{};
    std::array<Lanes, 3> edge_ab{};
    std::array<Lanes, 3> edge_ac{};
    Lanes longest{};       ///< edge
    Lanes area_bound{};    ///< |ab| |ac|, at least twice the area
    Lanes sliver_bound{};  ///< longest * |ab| |ac| / (twice the area); below 0: an empty place
    SurfaceRange surfaces;
};

struct alignas(32) SphereBlock {
    std::array<Lanes, 3> center{};
    Lanes radius{};  ///< below 0: an empty place
    SurfaceRange surfaces;
};

/// Cones and cylinders as the lower end, the unit direction to the other one, and how the radius grows along it.
struct alignas(32) ConeBlock {
    std::array<Lanes, 3> base{};
    std::array<Lanes, 3> axis{};
    Lanes radius{};  ///< of the lower end; below 0: an empty place
    Lanes slope{};
    Lanes length{};
    Lanes outside{};  ///< 1: the wall is there for rays from outside, too; otherwise 0
    SurfaceRange surfaces;
};

/// Levels of nodes that a search is ready for.
inline constexpr int k_max_levels = 64;

struct Tree {
    std::vector<Node> nodes;  ///< nodes[0] is the root
    std::vector<TriangleBlock> triangles;
    std::vector<SphereBlock> spheres;
    std::vector<ConeBlock> cones;
    SurfaceList surfaces;  ///< those of a block, and others that an item leads to, stand side by side

    [[nodiscard]] std::uint64_t bytes() const {
        return nodes.size() * sizeof(Node) + triangles.size() * sizeof(TriangleBlock) +
               spheres.size() * sizeof(SphereBlock) + cones.size() * sizeof(ConeBlock) +
               surfaces.size() * sizeof(const Surface*);
    }
};

}  // namespace raysteps::wide
