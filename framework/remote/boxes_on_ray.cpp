#include "remote/boxes_on_ray.hpp"

#include <cstring>
#include <map>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "remote/functions.hpp"

namespace raysteps::remote {
namespace {

constexpr std::size_t k_most_boxes = 2000;  // of one answer; a search that comes to more asks for them one by one

struct OpenTree {
    const Bvh* bvh = nullptr;
    int loans = 0;
};

std::map<TreeId, OpenTree>& lent_trees() {
    static std::map<TreeId, OpenTree> trees;
    return trees;
}

/// Visits the boxes from the root on, below those that the ray meets: visit(node) says whether it does.
template <typename Visit>
void walk(const Bvh& bvh, const Visit& visit) {
    std::vector<std::uint32_t> rest;
    if (!bvh.nodes.empty()) {
        rest.push_back(0);
    }
    for (std::size_t visited = 0; !rest.empty() && visited < k_most_boxes; ++visited) {
        const std::uint32_t place = rest.back();
        rest.pop_back();
        const BvhNode& node = bvh.nodes[place];
        if (visit(place) && !node.is_leaf() && std::size_t{node.first} + 1 < bvh.nodes.size()) {
            rest.push_back(node.first);
            rest.push_back(node.first + 1);
        }
    }
}

void serve_boxes(Reader& in, Wire& wire) {
    const auto found = lent_trees().find(in.get<TreeId>());
    if (found == lent_trees().end()) {
        throw BadMessage("a tree was asked that no open question has lent");
    }
    const Bvh& bvh = *found->second.bvh;
    const Ray ray = read<Ray>(in);
    send_answer(wire, [&](Writer& out) {
        walk(bvh, [&](std::uint32_t place) {
            const std::optional<Interval> part = bvh.nodes[place].box.clip(ray);
            write(out, part);
            return part.has_value();
        });
    });
}

[[maybe_unused]] const bool offered = offer(FunctionId::lent_boxes, serve_boxes);

struct SameBytes {
    bool operator()(const Box& a, const Box& b) const { return std::memcmp(&a, &b, sizeof a) == 0; }
};
struct HashOfBytes {
    std::size_t operator()(const Box& box) const {
        return std::hash<std::string_view>()({reinterpret_cast<const char*>(&box), sizeof box});
    }
};

/// The boxes of a tree by their corners: a search may have copied them.
using BoxNumbers = std::unordered_map<Box, std::uint32_t, HashOfBytes, SameBytes>;

struct SearchedTree {
    const Bvh* bvh = nullptr;
    BoxNumbers numbers;
    std::vector<std::uint32_t> number_of_node;
};

/// What is known of one ray.
struct Answers {
    TreeId tree = 0;
    bool asked = false;
    Ray ray;
    std::uint32_t round = 0;
    struct Answer {
        std::uint32_t round = 0;
        std::optional<Interval> part;
    };
    std::vector<Answer> of_box;
};

std::map<TreeId, SearchedTree>& searched_trees() {
    static std::map<TreeId, SearchedTree> trees;
    return trees;
}

Answers& answers_of_conversation() {
    static std::map<std::size_t, Answers> all;
    return all[Session::current().wire().current()];
}

void ask_boxes(const SearchedTree& tree, Answers& answers, const Ray& ray) {
    const TreeId id = answers.tree;
    const auto read_all = [&](Reader& in, const auto& /*open*/) {
        answers.asked = true;
        answers.ray = ray;
        ++answers.round;
        answers.of_box.resize(tree.numbers.size());
        walk(*tree.bvh, [&](std::uint32_t place) {
            const auto part = read<std::optional<Interval>>(in);
            answers.of_box[tree.number_of_node[place]] = {answers.round, part};
            return part.has_value();
        });
        return 0;
    };
    static_cast<void>(ask_and_read<TreeId, Ray>(FunctionId::lent_boxes, read_all, id, ray));
}

}  // namespace

TreeLoan::TreeLoan(TreeId id, const Bvh& bvh) : id_(id) {
    OpenTree& lent = lent_trees()[id];
    lent.bvh = &bvh;
    ++lent.loans;
}

TreeLoan::~TreeLoan() {
    const auto lent = lent_trees().find(id_);
    if (--lent->second.loans == 0) {
        lent_trees().erase(lent);
    }
}

void search_in(TreeId id, const Bvh& bvh) {
    constexpr TreeId k_kept = 16;  // as in trees.cpp
    searched_trees().erase(searched_trees().begin(), searched_trees().upper_bound(id > k_kept ? id - k_kept : 0));
    SearchedTree& tree = searched_trees()[id];
    if (tree.bvh != &bvh) {
        tree = {&bvh, {}, {}};
        for (const BvhNode& node : bvh.nodes) {
            const auto number = static_cast<std::uint32_t>(tree.numbers.size());
            tree.number_of_node.push_back(tree.numbers.try_emplace(node.box, number).first->second);
        }
    }
    Answers& answers = answers_of_conversation();
    if (answers.tree != id) {
        answers = {.tree = id, .asked = false, .ray = {}, .round = 0, .of_box = {}};
    }
}

std::optional<Interval> ask_clip(const Box& box, const Ray& ray) {
    Answers& answers = answers_of_conversation();
    const auto tree = searched_trees().find(answers.tree);
    if (tree != searched_trees().end()) {
        const auto number = tree->second.numbers.find(box);
        if (number != tree->second.numbers.end()) {
            if (!answers.asked || std::memcmp(&answers.ray, &ray, sizeof ray) != 0) {
                ask_boxes(tree->second, answers, ray);
            }
            const Answers::Answer& known = answers.of_box[number->second];
            if (known.round == answers.round) {
                return known.part;
            }
        }
    }
    return box.clip(ray);
}

}  // namespace raysteps::remote
