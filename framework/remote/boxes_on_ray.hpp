#pragma once
// Boxes of a tree and one ray. A search asks for many of them; the end that knows step 06's Box::clip answers for all
// at once that a search from the root on can come to.
#include <optional>

#include "core/box.hpp"
#include "core/bvh.hpp"
#include "remote/message.hpp"
#include "remote/wire.hpp"

namespace raysteps::remote {

using TreeId = std::uint32_t;

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

/// The tree that the question of the current conversation is about.
void search_in(TreeId id, const Bvh& bvh);

/// What step 06's box.clip(ray) gives. Asks the other end once for each ray, and again for a box of another tree.
[[nodiscard]] std::optional<Interval> ask_clip(const Box& box, const Ray& ray);

}  // namespace raysteps::remote
