#include "remote/trees.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <initializer_list>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "remote/functions.hpp"
#include "remote/serializer.hpp"

namespace raysteps::remote {
namespace {

constexpr TreeId k_kept = 16;  // trees that both ends remember
constexpr int k_deepest = 2000;
constexpr std::uint32_t k_nowhere = 0xFFFFFFFFU;  // an entry that is no surface of the group

/// By which a tree is found again that was sent before: where its parts are in memory, and some of its boxes. A tree
/// may be moved, which leaves the parts where they are.
class Mark {
public:
    void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x9E3779B97F4A7C15U + (value_ >> 29U); }
    template <typename T>
    void add(const std::vector<T>& list) {
        add(reinterpret_cast<std::uintptr_t>(list.data()));
        add(list.size());
    }
    void add(const Box& box) {
        for (const glm::vec3& corner : {box.min, box.max}) {
            for (int axis = 0; axis < 3; ++axis) {
                add(std::uint64_t{std::bit_cast<std::uint32_t>(corner[axis])});
            }
        }
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 1;
};

std::uint64_t mark_of(const Node& root) {
    Mark mark;
    const Node* node = &root;
    for (bool last = false;; last = !last) {  // one way down, by first and last children in turn
        mark.add(node->box);
        mark.add(node->surfaces);
        mark.add(node->children);
        if (node->children.empty()) {
            return mark.value();
        }
        node = last ? &node->children.back() : &node->children.front();
    }
}

std::uint64_t mark_of(const Bvh& bvh) {
    Mark mark;
    mark.add(bvh.nodes);
    mark.add(bvh.surfaces);
    if (!bvh.nodes.empty()) {
        mark.add(bvh.nodes.front().box);
    }
    return mark.value();
}

/// Which surface of the group an entry is, by number.
using IndexOf = std::function<std::uint32_t(const Surface*)>;

void write_entries(Writer& out, const SurfaceList& entries, const IndexOf& index_of) {
    out.put(static_cast<std::uint32_t>(entries.size()));
    for (const Surface* entry : entries) {
        out.put(index_of(entry));
    }
}

SurfaceList read_entries(Reader& in, const SurfaceList& group) {
    SurfaceList entries(in.count(sizeof(std::uint32_t)));
    for (const Surface*& entry : entries) {
        const auto index = in.get<std::uint32_t>();
        entry = index < group.size() ? group[index] : &no_surface();
    }
    return entries;
}

void write_parts(Writer& out, const Node& node, const IndexOf& index_of, int depth = 1) {
    if (depth > k_deepest) {
        throw std::length_error("the tree has more than " + std::to_string(k_deepest) + " levels");
    }
    write(out, node.box);
    write_entries(out, node.surfaces, index_of);
    out.put(static_cast<std::uint32_t>(node.children.size()));
    for (const Node& child : node.children) {
        write_parts(out, child, index_of, depth + 1);
    }
}

/// What a tree may be.
struct Bounds {
    int levels = k_deepest;
    std::size_t children = ~std::size_t{0};  ///< of a box
};
/// Of a tree that a box wants the reference to search, as it would search its own: as deep as build_bvh may build one,
/// and build_octree one of a small scene.
constexpr Bounds k_searched_at_home{.levels = 500, .children = 8};
constexpr int k_deepest_bvh = 64;

// Whether the reference can search a tree that comes from a box. A search follows every number in a tree; a tree of the
// reference's own never leads out.

/// Of a tree that a step here has built; those of a box are refused by the same bounds while they are read.
bool is_searchable(const Node& node, int level = 1) {
    const auto searchable = [level](const Node& child) { return is_searchable(child, level + 1); };
    return level <= k_searched_at_home.levels && node.children.size() <= k_searched_at_home.children &&
           std::all_of(node.children.begin(), node.children.end(), searchable);
}

bool is_searchable(const Bvh& bvh) {
    struct Place {
        std::size_t node;
        int level;
    };
    std::vector<bool> reached(bvh.nodes.size());
    std::vector<Place> rest;
    if (!bvh.nodes.empty()) {
        rest.push_back({.node = 0, .level = 1});
    }
    while (!rest.empty()) {
        const auto [place, level] = rest.back();
        rest.pop_back();
        if (place >= bvh.nodes.size() || reached[place] || level > k_deepest_bvh) {
            return false;
        }
        reached[place] = true;
        const BvhNode& node = bvh.nodes[place];
        const std::size_t first = node.first;
        if (!node.is_leaf()) {
            rest.push_back({.node = first + 1, .level = level + 1});
            rest.push_back({.node = first, .level = level + 1});
        } else if (first + node.count > bvh.surfaces.size()) {
            return false;
        }
    }
    return true;
}

void read_parts(Reader& in, const SurfaceList& group, Node& node, Bounds bounds = {}) {
    node.box = read<Box>(in);
    node.surfaces = read_entries(in, group);
    const std::size_t children = in.count(sizeof(Box));
    if (children > bounds.children || (children > 0 && bounds.levels <= 1)) {
        throw BadMessage("a tree has too many levels or children");
    }
    node.children.resize(children);
    for (Node& child : node.children) {
        read_parts(in, group, child, {.levels = bounds.levels - 1, .children = bounds.children});
    }
}

void write_parts(Writer& out, const Bvh& bvh, const IndexOf& index_of) {
    out.put(static_cast<std::uint32_t>(bvh.nodes.size()));
    for (const BvhNode& node : bvh.nodes) {
        write(out, node.box);
        out.put(node.first);
        out.put(node.count);
    }
    write_entries(out, bvh.surfaces, index_of);
}

void read_parts(Reader& in, const SurfaceList& group, Bvh& bvh) {
    bvh.nodes.resize(in.count(sizeof(Box)));
    for (BvhNode& node : bvh.nodes) {
        node.box = read<Box>(in);
        node.first = in.get<std::uint32_t>();
        node.count = in.get<std::uint32_t>();
    }
    bvh.surfaces = read_entries(in, group);
}

// A tree that a box wants the reference to search. Nested boxes are refused while they are read, since the reader goes
// down them by calling itself; where the numbers of a list lead is seen when all of it is there.

void read_searched(Reader& in, const SurfaceList& group, Node& root) {
    read_parts(in, group, root, k_searched_at_home);
}
void read_searched(Reader& in, const SurfaceList& group, Bvh& bvh) {
    read_parts(in, group, bvh);
    if (!is_searchable(bvh)) {
        throw BadMessage("a tree leads out of itself");
    }
}

/// The surfaces of a tree, each once.
void collect(const SurfaceList& entries, std::unordered_map<const Surface*, std::uint32_t>& numbers,
             SurfaceList& surfaces) {
    for (const Surface* entry : entries) {
        if (numbers.try_emplace(entry, static_cast<std::uint32_t>(surfaces.size())).second) {
            surfaces.push_back(entry);
        }
    }
}
void collect(const Node& node, std::unordered_map<const Surface*, std::uint32_t>& numbers, SurfaceList& surfaces) {
    collect(node.surfaces, numbers, surfaces);
    for (const Node& child : node.children) {
        collect(child, numbers, surfaces);
    }
}
void collect(const Bvh& bvh, std::unordered_map<const Surface*, std::uint32_t>& numbers, SurfaceList& surfaces) {
    collect(bvh.surfaces, numbers, surfaces);
}

bool is_same(const Box& a, const Box& b) { return a.min == b.min && a.max == b.max; }
bool is_same(const Node& a, const Node& b) {
    const auto same = [](const Node& x, const Node& y) { return is_same(x, y); };
    return is_same(a.box, b.box) && a.surfaces == b.surfaces &&
           std::equal(a.children.begin(), a.children.end(), b.children.begin(), b.children.end(), same);
}
bool is_same(const Bvh& a, const Bvh& b) {
    const auto same = [](const BvhNode& x, const BvhNode& y) {
        return is_same(x.box, y.box) && x.first == y.first && x.count == y.count;
    };
    return a.surfaces == b.surfaces && std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same);
}

void number_boxes(KnownTree<Node>& /*known*/) {}
void number_boxes(KnownTree<Bvh>& known) {
    if (!Session::offers(FunctionId::box_clip)) {
        known.numbers = std::make_unique<BoxNumbers>(known.tree);
    }
}

/// What one end knows of the trees of one kind.
template <typename Tree>
class Trees {
public:
    struct Sent {
        std::uint64_t mark;
        Tree copy;
        std::shared_ptr<OwnGroup> group;
        std::uint64_t checked_in = 0;  ///< the call of run_together in which it was last compared as a whole
    };

    static Trees& all() {
        static Trees trees;
        return trees;
    }

    [[nodiscard]] TreeId next() { return ++last_; }

    void remember(TreeId id, const Tree& tree, std::shared_ptr<OwnGroup> group) {
        sent_[id] = {mark_of(tree), tree, std::move(group)};
        forget_old(sent_, id);
    }
    /// Null for a tree that was not sent as it is now. Another one may lie where a tree was that is gone.
    [[nodiscard]] const std::pair<const TreeId, Sent>* find(const Tree& tree) {
        const std::uint64_t mark = mark_of(tree);
        const std::uint64_t together = Session::current().wire().together();
        for (auto one = sent_.rbegin(); one != sent_.rend(); ++one) {
            Sent& sent = one->second;
            if (sent.mark != mark) {
                continue;
            }
            const bool checked = together != 0 && sent.checked_in == together;
            if (checked || (is_same(sent.copy, tree) && Groups::is_unchanged(*sent.group))) {
                sent.checked_in = together;
                return &*one;
            }
        }
        return nullptr;
    }

    void keep(const std::shared_ptr<KnownTree<Tree>>& tree) {
        if (!kept_.empty() && tree->id <= kept_.rbegin()->first && Session::current().side() == Session::Side::home) {
            throw BadMessage("trees came in another order than that of their numbers");
        }
        if (!Session::offers(FunctionId::sphere_intersect)) {
            enter_leaves(tree->tree, tree->entries);
        }
        number_boxes(*tree);
        kept_[tree->id] = tree;
        forget_old(kept_, tree->id);
    }
    [[nodiscard]] std::shared_ptr<const KnownTree<Tree>> kept(TreeId id) const {
        const auto found = kept_.find(id);
        if (found == kept_.end()) {
            throw BadMessage("this tree is not known here");
        }
        return found->second;
    }

private:
    template <typename Map>
    static void forget_old(Map& map, TreeId newest) {
        map.erase(map.begin(), map.upper_bound(newest > k_kept ? newest - k_kept : 0));
    }

    std::map<TreeId, Sent> sent_;
    std::map<TreeId, std::shared_ptr<const KnownTree<Tree>>> kept_;
    TreeId last_ = 0;
};

LentTree lend(TreeId /*id*/, const Node& /*root*/, const std::shared_ptr<OwnGroup>& group) {
    return {Loan(group), nullptr};
}
LentTree lend(TreeId id, const Bvh& bvh, const std::shared_ptr<OwnGroup>& group) {
    return {Loan(group), std::make_unique<TreeLoan>(id, bvh)};
}

void write_boxes_of(Writer& /*out*/, const Search<Node>& /*search*/) {}
void write_boxes_of(Writer& out, const Search<Bvh>& search) {
    if (!Session::asks(FunctionId::box_clip)) {
        write_boxes(out, search.tree, search.ray);
    }
}

void begin(const KnownTree<Node>& /*known*/, const Search<Node>& search, Reader& /*in*/) { begin_search(search.until); }
void begin(const KnownTree<Bvh>& known, const Search<Bvh>& search, Reader& in) {
    if (known.numbers == nullptr) {
        begin_search(search.until);
    } else {
        begin_search(search.until, known.id, *known.numbers, search.ray, in);
    }
}

/// Only where the reference stands in for a function of this step does the program offer what it asks of others: then
/// the search may be the reference's, too.
template <typename Tree>
void require_searchable(const Tree& tree, FunctionId search) {
    if (Session::offers(search) && !is_searchable(tree)) {
        throw std::invalid_argument("the tree leads out of itself, has too many levels, or more than 8 boxes in one");
    }
}

template <typename Tree>
Tree ask_tree(FunctionId id, FunctionId search, const SurfaceList& surfaces) {
    const TreeId number = Trees<Tree>::all().next();
    const auto read_result = [&](Reader& in, const auto& open) {
        const std::shared_ptr<OwnGroup>& group = std::get<1>(open).group();
        Tree tree;
        read_parts(in, group->surfaces, tree);
        require_searchable(tree, search);
        Trees<Tree>::all().remember(number, tree, group);
        return tree;
    };
    return ask_and_read<TreeId, const ToCopy&>(id, read_result, number, {surfaces});
}

template <typename Tree>
void serve_tree(Tree (*build)(const SurfaceList&), Reader& in, Wire& wire) {
    const auto id = in.get<TreeId>();
    const std::shared_ptr<CopiedGroup> group = Groups::all().read(in);
    auto known = std::make_shared<KnownTree<Tree>>();
    known->id = id;
    known->tree = build(group->scene.surfaces());
    known->group = group;
    const Groups& groups = Groups::all();
    const IndexOf index_of = [&](const Surface* entry) {
        const SurfaceRef* place = groups.place_of(entry);
        return place != nullptr && place->group == group->id ? place->index : k_nowhere;
    };
    send_answer(wire, [&](Writer& out) { write_parts(out, known->tree, index_of); });
    Trees<Tree>::all().keep(known);
}

/// Writes which tree is meant, and all of it where the box does not know it.
template <typename Tree>
LentTree write_tree(Writer& out, const Tree& tree) {
    Trees<Tree>& trees = Trees<Tree>::all();
    const auto* known = trees.find(tree);
    out.put(known != nullptr);
    if (known != nullptr) {
        out.put(known->first);
        return lend(known->first, tree, known->second.group);
    }
    std::unordered_map<const Surface*, std::uint32_t> numbers;
    SurfaceList surfaces;
    collect(tree, numbers, surfaces);
    const TreeId id = trees.next();
    out.put(id);
    const std::shared_ptr<OwnGroup> group = Groups::all().write(out, surfaces);
    write_parts(out, tree, [&](const Surface* entry) { return numbers.at(entry); });
    trees.remember(id, tree, group);
    return lend(id, tree, group);
}

template <typename Tree>
std::shared_ptr<const KnownTree<Tree>> read_tree(Reader& in) {
    Trees<Tree>& trees = Trees<Tree>::all();
    const bool is_known = in.get<bool>();
    const auto id = in.get<TreeId>();
    if (is_known) {
        return trees.kept(id);
    }
    auto known = std::make_shared<KnownTree<Tree>>();
    known->id = id;
    known->group = Groups::all().read(in);
    const SurfaceList& surfaces = known->group->scene.surfaces();
    if (Session::current().side() == Session::Side::home) {
        read_searched(in, surfaces, known->tree);
    } else {
        read_parts(in, surfaces, known->tree);
    }
    trees.keep(known);
    return known;
}

}  // namespace

template <typename Tree>
LentTree write_search(Writer& out, const Search<Tree>& search) {
    LentTree lent = write_tree(out, search.tree);
    write(out, search.ray);
    out.put(search.until);
    write_boxes_of(out, search);
    return lent;
}

template <typename Tree>
ReceivedSearch<Tree> read_search(Reader& in) {
    std::shared_ptr<const KnownTree<Tree>> known = read_tree<Tree>(in);
    const Ray ray = read<Ray>(in);
    const Search<Tree> search{known->tree, ray, in.get<float>()};
    begin(*known, search, in);
    return {std::move(known), search, OpenSearch()};
}

template LentTree write_search(Writer&, const Search<Node>&);
template LentTree write_search(Writer&, const Search<Bvh>&);
template ReceivedSearch<Node> read_search(Reader&);
template ReceivedSearch<Bvh> read_search(Reader&);

Node ask_octree(const SurfaceList& surfaces) {
    return ask_tree<Node>(FunctionId::build_octree, FunctionId::closest_hit_in_octree, surfaces);
}
Bvh ask_bvh(const SurfaceList& surfaces) {
    return ask_tree<Bvh>(FunctionId::build_bvh, FunctionId::closest_hit_in_bvh, surfaces);
}
void serve_octree(Node (*build)(const SurfaceList&), Reader& in, Wire& wire) { serve_tree(build, in, wire); }
void serve_bvh(Bvh (*build)(const SurfaceList&), Reader& in, Wire& wire) { serve_tree(build, in, wire); }

}  // namespace raysteps::remote
