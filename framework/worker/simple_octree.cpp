#include "worker/simple_octree.hpp"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <unordered_map>

#include "worker/protocol.hpp"

namespace raysteps {
namespace {

constexpr int k_levels = 3;
constexpr std::size_t k_few = 2;  // surfaces, for which one box will do
constexpr int k_deepest = 500;    // what has more levels is not told, either

bool apart(const Box& a, const Box& b) {
    return glm::any(glm::greaterThan(a.min, b.max)) || glm::any(glm::greaterThan(b.min, a.max));
}

Node simple_node(const Box& box, const SurfaceList& surfaces, int level) {
    Node node;
    node.box = box;
    SurfaceList touching;
    for (const Surface* surface : surfaces) {
        if (!apart(surface->bounds(), box)) {
            touching.push_back(surface);
        }
    }
    if (level == k_levels) {
        node.surfaces = touching;
        return node;
    }
    const glm::vec3 half = 0.5F * (box.max - box.min);
    const glm::vec3 overlap = 1e-4F * half;  // so that rounding opens no gap between two boxes
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner = box.min + half * glm::vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1);
        node.children.push_back(simple_node({corner - overlap, corner + half + overlap}, touching, level + 1));
    }
    return node;
}

class TreeWriter {
public:
    explicit TreeWriter(const SurfaceList& surfaces) {
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            numbers_[surfaces[i]] = static_cast<int>(i);
        }
    }

    /// Of what the tree has too much; nothing when it was small enough.
    const char* write(TokenWriter& answer, const Node& node, int depth) {
        nodes_ += 1;
        entries_ += node.surfaces.size();
        if (nodes_ > k_max_nodes || depth > k_deepest) {
            return depth > k_deepest ? "levels" : "boxes";
        }
        if (entries_ > k_max_entries) {
            return "entries";
        }
        write_box(answer, node.box);
        answer.whole(static_cast<long long>(node.surfaces.size()));
        for (const Surface* surface : node.surfaces) {
            const auto found = numbers_.find(surface);
            answer.whole(found == numbers_.end() ? -1 : found->second);
        }
        answer.whole(static_cast<long long>(node.children.size()));
        for (const Node& child : node.children) {
            if (const char* what = write(answer, child, depth + 1)) {
                return what;
            }
        }
        return nullptr;
    }

private:
    std::unordered_map<const Surface*, int> numbers_;
    std::size_t nodes_ = 0;
    std::size_t entries_ = 0;
};

}  // namespace

Node simple_tree(const SurfaceList& surfaces) {
    Box all;
    for (const Surface* surface : surfaces) {
        all.extend(surface->bounds());
    }
    const glm::vec3 padding = 1e-3F * (all.max - all.min) + 1e-3F;
    const int level = surfaces.size() <= k_few ? k_levels : 1;
    return surfaces.empty() ? Node{} : simple_node({all.min - padding, all.max + padding}, surfaces, level);
}

void write_tree(TokenWriter& answer, const Node& root, const SurfaceList& surfaces) {
    TokenWriter tree;
    if (const char* what = TreeWriter(surfaces).write(tree, root, 0)) {
        answer.word("large").word(what);
        return;
    }
    answer.word("tree").word(std::string_view(tree.text()).substr(1));
}

}  // namespace raysteps
