#pragma once
// A search in a tree asks for one box and one surface after the other. What it is about to ask comes with the first
// answers: all boxes that the ray can come to, and the rest of a leaf.
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/bvh.hpp"
#include "core/node.hpp"
#include "core/scene.hpp"
#include "remote/groups.hpp"
#include "remote/message.hpp"

namespace raysteps::remote {

using TreeId = std::uint32_t;

/// What a question about a tree and a ray says.
template <typename Tree>
struct Search {
    const Tree& tree;
    Ray ray;
    float until = 0.0F;  ///< a hit nearer than this ends the search
};

// At the end that has the boxes and the surfaces.

/// While it exists, the other end may ask for the boxes of this tree.
class TreeLoan {
public:
    TreeLoan(TreeId id, const Bvh& bvh);
    TreeLoan(const TreeLoan&) = delete;
    TreeLoan& operator=(const TreeLoan&) = delete;
    ~TreeLoan();

private:
    TreeId id_;
};

/// What step 06's box.clip(ray) gives for all boxes that a search from the root on can come to.
void write_boxes(Writer& out, const Bvh& bvh, const Ray& ray);

// In the box.

/// Where the boxes of a tree are found again: a search may have copied them.
class BoxNumbers {
public:
    explicit BoxNumbers(const Bvh& bvh);

    /// Boxes alike have one number.
    [[nodiscard]] std::optional<std::uint32_t> find(const Box& box) const;
    [[nodiscard]] std::uint32_t of_node(std::uint32_t place) const { return of_node_[place]; }
    [[nodiscard]] const Bvh& bvh() const { return bvh_; }

private:
    struct SameBytes {
        bool operator()(const Box& a, const Box& b) const;
    };
    struct HashOfBytes {
        std::size_t operator()(const Box& box) const;
    };

    const Bvh& bvh_;
    std::vector<std::uint32_t> of_node_;
    std::unordered_map<Box, std::uint32_t, HashOfBytes, SameBytes> of_box_;
};

/// Surfaces side by side in a leaf and nowhere else in the tree, as the other end knows them.
struct Leaf {
    GroupId group = 0;
    std::vector<std::uint32_t> indices;
    std::uint32_t end = 0;  ///< beyond the highest of these
};

/// Stands in a leaf for a copy of a surface, and knows what comes after it.
class LeafEntry final : public Surface {
public:
    LeafEntry(const Surface& copy, std::shared_ptr<const Leaf> leaf, std::size_t place);

    /// Asked of the other end with those after it that are not known yet; a search that asks for these next finds their
    /// answers here. All that came are counted there as tested.
    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override;
    [[nodiscard]] Box bounds() const override { return copy_.bounds(); }
    [[nodiscard]] bool overlaps(const Box& box) const override { return copy_.overlaps(box); }
    [[nodiscard]] Shape shape() const override { return copy_.shape(); }
    [[nodiscard]] SurfaceRef place() const { return {leaf_->group, leaf_->indices[place_]}; }

private:
    const Surface& copy_;
    std::shared_ptr<const Leaf> leaf_;
    std::size_t place_;
};

/// Puts such entries into the leaves of a tree of copies. `entries` then owns them.
void enter_leaves(Node& root, Scene& entries);
void enter_leaves(Bvh& bvh, Scene& entries);

/// A search begins in the current conversation. For a tree with boxes of the other end's, their answers follow.
void begin_search(float until);
void begin_search(float until, TreeId id, const BoxNumbers& numbers, const Ray& ray, Reader& in);

/// Ends the search of the current conversation: nothing that was known for it is used any more.
class OpenSearch {
public:
    OpenSearch() = default;
    OpenSearch(OpenSearch&& other) noexcept : open_(std::exchange(other.open_, false)) {}
    OpenSearch& operator=(OpenSearch&&) = delete;
    ~OpenSearch();

private:
    bool open_ = true;
};

/// What step 06's box.clip(ray) gives: as it came along, or asked for.
[[nodiscard]] std::optional<Interval> ask_clip(const Box& box, const Ray& ray);

}  // namespace raysteps::remote
