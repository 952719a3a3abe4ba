#pragma once
// Trees of boxes. A tree that a student's function has built stays in the box, where it is searched; the program gets a
// copy to look at. A tree of anybody else's is sent once.
#include <cstdint>
#include <memory>

#include "core/bvh.hpp"
#include "core/node.hpp"
#include "remote/groups.hpp"
#include "remote/message.hpp"
#include "remote/searches.hpp"
#include "remote/wire.hpp"

namespace raysteps::remote {

/// A tree in the box, and what it is made of.
template <typename Tree>
struct KnownTree {
    TreeId id = 0;
    Tree tree;
    std::shared_ptr<CopiedGroup> group;
    Scene entries;                        ///< of the leaves
    std::unique_ptr<BoxNumbers> numbers;  ///< of a Bvh whose boxes the other end clips
};

/// What a question about a tree lends.
struct LentTree {
    Loan surfaces;
    std::unique_ptr<TreeLoan> boxes;  ///< of a Bvh
};

/// A question about a tree and a ray.
template <typename Tree>
[[nodiscard]] LentTree write_search(Writer& out, const Search<Tree>& search);
template <typename Tree>
struct ReceivedSearch {
    std::shared_ptr<const KnownTree<Tree>> known;
    Search<Tree> search;
    OpenSearch open;
};
template <typename Tree>
[[nodiscard]] ReceivedSearch<Tree> read_search(Reader& in);

/// A function of a step that builds a tree, seen from the program: asks the box, and knows the tree from then on.
[[nodiscard]] Node ask_octree(const SurfaceList& surfaces);
[[nodiscard]] Bvh ask_bvh(const SurfaceList& surfaces);

/// The same in the box.
void serve_octree(Node (*build)(const SurfaceList&), Reader& in, Wire& wire);
void serve_bvh(Bvh (*build)(const SurfaceList&), Reader& in, Wire& wire);

}  // namespace raysteps::remote
