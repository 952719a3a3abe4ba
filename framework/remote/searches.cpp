#include "remote/searches.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <span>
#include <string_view>

#include "remote/functions.hpp"

namespace raysteps::remote {
namespace {

constexpr std::size_t k_max_boxes = 2000;     // of one answer; a search that comes to more asks for them one by one
constexpr std::size_t k_max_surfaces = 4096;  // likewise

struct OpenTree {
    const Bvh* bvh = nullptr;
    int loans = 0;
    UseCount uses;
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
    for (std::size_t visited = 0; !rest.empty() && visited < k_max_boxes; ++visited) {
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
    const UseGuard use(found->second.uses);
    const Ray ray = read<Ray>(in);
    send_answer(wire, [&](Writer& out) { write_boxes(out, *found->second.bvh, ray); });
}

/// Up to the first that ends the search.
std::vector<std::optional<HitRecord>> hits_of(GroupId group, const std::vector<std::uint32_t>& indices, const Ray& ray,
                                              float until) {
    if (indices.size() > k_max_surfaces) {
        throw BadMessage("more surfaces were asked than a leaf's");
    }
    const UseGuard use = Groups::all().use(group);
    std::vector<std::optional<HitRecord>> hits;
    for (const std::uint32_t index : indices) {
        hits.push_back(Groups::all().lent({group, index}).hit(ray));
        if (hits.back() && hits.back()->distance < until) {
            break;
        }
    }
    return hits;
}

[[maybe_unused]] const bool offered_ahead = register_service(FunctionId::lent_boxes, serve_boxes) &&
                                            offer_function<&hits_of>(FunctionId::lent_surface_hits) &&
                                            calls_only(FunctionId::lent_boxes, {FunctionId::box_clip}) &&
                                            calls_only(FunctionId::lent_surface_hits, k_called_by_surfaces);

template <typename T>
bool same_bytes(const T& a, const T& b) {
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): a zero of the other sign may clip otherwise
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// What is known in one conversation.
struct State {
    float until = 0.0F;

    const BoxNumbers* numbers = nullptr;
    TreeId tree = 0;
    Ray box_ray;
    std::uint32_t round = 0;
    struct Answer {
        std::uint32_t round = 0;
        std::optional<Interval> part;
    };
    std::vector<Answer> of_box;

    /// Of surfaces in leaves, by their place in the group; what has another mark than `leaf_round` is of old.
    struct Hit {
        std::uint32_t round = 0;
        std::uint32_t answer = 0;
    };
    GroupId group = 0;
    Ray leaf_ray;
    std::uint32_t leaf_round = 1;
    std::vector<Hit> of_surface;
    std::vector<std::optional<HitRecord>> answers;

    /// Makes place for answers of these surfaces to this ray.
    void look_at(const Leaf& leaf, const Ray& ray) {
        if (group != leaf.group || !same_bytes(leaf_ray, ray)) {
            forget_hits();
            group = leaf.group;
            leaf_ray = ray;
        }
        if (of_surface.size() < leaf.end) {
            of_surface.resize(leaf.end);
        }
    }
    [[nodiscard]] bool knows(std::uint32_t index) const { return of_surface[index].round == leaf_round; }
    void learn(std::uint32_t index, const std::optional<HitRecord>& hit) {
        of_surface[index] = {leaf_round, static_cast<std::uint32_t>(answers.size())};
        answers.push_back(hit);
    }
    void forget_hits() {
        ++leaf_round;
        answers.clear();
    }
};

State& state() {
    static std::array<std::unique_ptr<State>, Wire::k_max_conversations> all;
    std::unique_ptr<State>& current = all.at(Session::current().wire().current());
    if (current == nullptr) {
        current = std::make_unique<State>();
    }
    return *current;
}

void read_boxes(Reader& in, State& known, const Ray& ray) {
    known.box_ray = ray;
    ++known.round;
    const Bvh& bvh = known.numbers->bvh();
    known.of_box.resize(std::max(known.of_box.size(), bvh.nodes.size()));
    walk(bvh, [&](std::uint32_t place) {
        const auto part = read<std::optional<Interval>>(in);
        known.of_box[known.numbers->of_node(place)] = {known.round, part};
        return part.has_value();
    });
}

void ask_boxes(State& known, const Ray& ray) {
    const auto read_all = [&](Reader& in, const auto& /*open*/) {
        read_boxes(in, known, ray);
        return 0;
    };
    static_cast<void>(ask_and_read<TreeId, Ray>(FunctionId::lent_boxes, read_all, known.tree, ray));
}

/// How often each surface is in a tree.
using Occurrences = std::unordered_map<const Surface*, int>;

void count(const Node& node, Occurrences& times) {
    for (const Surface* entry : node.surfaces) {
        ++times[entry];
    }
    for (const Node& child : node.children) {
        count(child, times);
    }
}

void enter_run(std::span<const Surface*> run, Scene& entries) {
    const auto leaf = std::make_shared<Leaf>();
    for (const Surface* surface : run) {
        const SurfaceRef place = *Groups::all().place_of(surface);
        leaf->group = place.group;
        leaf->indices.push_back(place.index);
        leaf->end = std::max(leaf->end, place.index + 1);
    }
    for (std::size_t place = 0; place < run.size(); ++place) {
        entries.add(std::make_unique<LeafEntry>(*run[place], leaf, place), run[place]->order());
        run[place] = entries.surfaces().back();
    }
}

/// A surface in several leaves stays the same in all of them, for a search that remembers what it has tested. Such a
/// one ends a run: whether the search comes to what is behind it nobody knows.
void enter_leaf(std::span<const Surface*> leaf, const Occurrences& times, Scene& entries) {
    const auto is_in_run = [&](const Surface* surface) {
        return times.at(surface) == 1 && Groups::all().place_of(surface) != nullptr;
    };
    for (auto begin = leaf.begin(); begin != leaf.end();) {
        begin = std::find_if(begin, leaf.end(), is_in_run);
        const auto end = std::find_if_not(begin, leaf.end(), is_in_run);
        enter_run({begin, end}, entries);
        begin = end;
    }
}

void enter_node(Node& node, const Occurrences& times, Scene& entries) {
    enter_leaf(node.surfaces, times, entries);
    for (Node& child : node.children) {
        enter_node(child, times, entries);
    }
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
        lent->second.uses.require_none();
        lent_trees().erase(lent);
    }
}

void write_boxes(Writer& out, const Bvh& bvh, const Ray& ray) {
    walk(bvh, [&](std::uint32_t place) {
        const std::optional<Interval> part = bvh.nodes[place].box.clip(ray);
        write(out, part);
        return part.has_value();
    });
}

bool BoxNumbers::SameBytes::operator()(const Box& a, const Box& b) const { return same_bytes(a, b); }

std::size_t BoxNumbers::HashOfBytes::operator()(const Box& box) const {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(&box), sizeof box});
}

BoxNumbers::BoxNumbers(const Bvh& bvh) : bvh_(bvh) {
    for (std::size_t place = 0; place < bvh.nodes.size(); ++place) {
        const auto number = static_cast<std::uint32_t>(place);
        of_node_.push_back(of_box_.try_emplace(bvh.nodes[place].box, number).first->second);
    }
}

std::optional<std::uint32_t> BoxNumbers::find(const Box& box) const {
    // Most searches ask for the boxes of the nodes themselves.
    const auto offset = reinterpret_cast<std::uintptr_t>(&box) - reinterpret_cast<std::uintptr_t>(bvh_.nodes.data());
    const std::size_t place = offset / sizeof(BvhNode);
    if (place < of_node_.size() && &bvh_.nodes[place].box == &box) {
        return of_node_[place];
    }
    const auto found = of_box_.find(box);
    return found == of_box_.end() ? std::nullopt : std::optional(found->second);
}

LeafEntry::LeafEntry(const Surface& copy, std::shared_ptr<const Leaf> leaf, std::size_t place)
    : Surface(copy.fill()), copy_(copy), leaf_(std::move(leaf)), place_(place) {}

std::optional<HitRecord> LeafEntry::intersect(const Ray& ray) const {
    State& known = state();
    known.look_at(*leaf_, ray);
    const std::uint32_t index = leaf_->indices[place_];
    if (!known.knows(index)) {
        std::span<const std::uint32_t> rest(leaf_->indices);
        rest = rest.subspan(place_, std::min(rest.size() - place_, k_max_surfaces));
        rest = {rest.begin(), std::find_if(rest.begin(), rest.end(), [&](auto one) { return known.knows(one); })};
        using Hits = std::vector<std::optional<HitRecord>>;
        const Hits hits = ask<Hits, GroupId, std::span<const std::uint32_t>, Ray, float>(
            FunctionId::lent_surface_hits, leaf_->group, rest, ray, known.until);
        for (std::size_t place = 0; place < std::min(hits.size(), rest.size()); ++place) {
            known.learn(rest[place], hits[place]);
        }
    }
    return known.answers.at(known.of_surface[index].answer);
}

void enter_leaves(Node& root, Scene& entries) {
    Occurrences times;
    count(root, times);
    enter_node(root, times, entries);
}

void enter_leaves(Bvh& bvh, Scene& entries) {
    Occurrences times;
    for (const Surface* entry : bvh.surfaces) {
        ++times[entry];
    }
    std::vector<bool> entered(bvh.surfaces.size());
    for (const BvhNode& node : bvh.nodes) {
        const std::size_t last = std::size_t{node.first} + node.count;
        if (!node.is_leaf() || last > entered.size()) {
            continue;
        }
        const auto begin = entered.begin() + node.first;
        const auto end = entered.begin() + static_cast<std::ptrdiff_t>(last);
        if (std::find(begin, end, true) == end) {
            std::fill(begin, end, true);
            enter_leaf(std::span(bvh.surfaces).subspan(node.first, node.count), times, entries);
        }
    }
    // What is in no leaf a search can come to only by going through the list.
    for (auto begin = entered.begin(); begin != entered.end();) {
        begin = std::find(begin, entered.end(), false);
        const auto end = std::find(begin, entered.end(), true);
        const auto first = static_cast<std::size_t>(begin - entered.begin());
        enter_leaf(std::span(bvh.surfaces).subspan(first, static_cast<std::size_t>(end - begin)), times, entries);
        begin = end;
    }
}

void begin_search(float until) {
    State& known = state();
    known.until = until;
    known.forget_hits();
    known.numbers = nullptr;
}

OpenSearch::~OpenSearch() {
    if (open_) {
        begin_search(0.0F);
    }
}

void begin_search(float until, TreeId id, const BoxNumbers& numbers, const Ray& ray, Reader& in) {
    begin_search(until);
    State& known = state();
    known.numbers = &numbers;
    known.tree = id;
    read_boxes(in, known, ray);
}

std::optional<Interval> ask_clip(const Box& box, const Ray& ray) {
    State& known = state();
    const std::optional<std::uint32_t> number = known.numbers == nullptr ? std::nullopt : known.numbers->find(box);
    if (!number) {
        return box.clip(ray);
    }
    if (!same_bytes(known.box_ray, ray)) {
        ask_boxes(known, ray);
    }
    const State::Answer& answer = known.of_box[*number];
    return answer.round == known.round ? answer.part : box.clip(ray);
}

}  // namespace raysteps::remote
