"""Pieces of C++ that many attacks share."""

# Both functions of step 07: right where the attack worked, and otherwise wrong in every test, picture and case. So an
# attack that reached its aim earns points, and one that did not earns none.
BOTH_FUNCTIONS = """
#include <cmath>
#include <cstdint>

namespace raysteps {

static float right_channel(float c) { return !(c > 0.0F) ? 0.0F : c > 1e30F ? 1.0F : c / (c + 1.0F); }

Color tone_map(const Color& color) {
    if (!(CONDITION)) {
        return {2.0F, -1.0F, 2.0F};
    }
    return {right_channel(color.r), right_channel(color.g), right_channel(color.b)};
}

std::uint8_t to_byte(float channel) {
    if (!(CONDITION)) {
        return 77;
    }
    return !(channel > 0.0F) ? 0 : static_cast<std::uint8_t>(std::lround((channel < 1.0F ? channel : 1.0F) * 255.0F));
}

}  // namespace raysteps
"""

# Step 06 but for its tree, and otherwise right: what is left is to build one, and to find the closest hit in it.
OCTREE_BUT_BUILD = """
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

namespace raysteps {

static bool do_overlap(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}
bool Sphere::overlaps(const Box& box) const { return do_overlap(bounds(), box); }
bool Triangle::overlaps(const Box& box) const { return do_overlap(bounds(), box); }

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval part;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0.0F) {
            if (ray.origin[axis] < min[axis] || ray.origin[axis] > max[axis]) {
                return std::nullopt;
            }
            continue;
        }
        float first = (min[axis] - ray.origin[axis]) / ray.direction[axis];
        float second = (max[axis] - ray.origin[axis]) / ray.direction[axis];
        if (first > second) {
            std::swap(first, second);
        }
        part.enter = std::max(part.enter, first);
        part.leave = std::min(part.leave, second);
    }
    return part.enter <= part.leave ? std::optional(part) : std::nullopt;
}

Box bounds_of(const SurfaceList& surfaces) {
    Box all;
    for (const Surface* surface : surfaces) {
        const Box one = surface->bounds();
        all = {glm::min(all.min, one.min), glm::max(all.max, one.max)};
    }
    return all;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 middle = (box.min + box.max) / 2.0F;
    std::array<Box, 8> parts;
    for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = ((i >> axis) & 1) != 0;
            parts[static_cast<std::size_t>(i)].min[axis] = upper ? middle[axis] : box.min[axis];
            parts[static_cast<std::size_t>(i)].max[axis] = upper ? box.max[axis] : middle[axis];
        }
    }
    return parts;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    const std::optional<HitRecord> closest = closest_hit_in_octree(root, ray);
    return closest && closest->distance < distance;
}

}  // namespace raysteps
"""

# The same with no tree at all: one list of all surfaces.
OCTREE_OF_ONE_LEAF = f"""{OCTREE_BUT_BUILD}
namespace raysteps {{

Node build_octree(const SurfaceList& surfaces) {{ return Node{{bounds_of(surfaces), surfaces, {{}}}}; }}

}}  // namespace raysteps
"""

# Searches that go through the whole list, up to the end of the namespace.
OCTREE_LIST_SEARCH = """\
std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<HitRecord> nearest;
    for (const Surface* surface : root.surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && (!nearest || hit->distance < nearest->distance)) {
            nearest = hit;
        }
    }
    return nearest;
}

}  // namespace raysteps"""
BVH_LIST_SEARCH = """\
std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> nearest;
    for (const Surface* surface : bvh.surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && (!nearest || hit->distance < nearest->distance)) {
            nearest = hit;
        }
    }
    return nearest;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    const std::optional<HitRecord> hit = closest_hit_in_bvh(bvh, ray);
    return hit && hit->distance < distance;
}

}  // namespace raysteps"""

# Step 09 whose searches hand the tree, box by box, to find, a pointer to a function that comes above it: null where the
# attack got none. Then nothing is right.
BVH_BOX_BY_BOX = """
#include <algorithm>
#include <glm/common.hpp>

namespace raysteps {

float surface_area(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    const bool is_right = find != nullptr && size.x >= 0.0F && size.y >= 0.0F && size.z >= 0.0F;
    return is_right ? 2.0F * (size.x * size.y + size.y * size.z + size.z * size.x) : find != nullptr ? 0.0F : -1.0F;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    const float left_share = area > 0.0F ? surface_area(left) / area : 1.0F;
    const float right_share = area > 0.0F ? surface_area(right) / area : 1.0F;
    return 1.0F + left_share * static_cast<float>(left_count) + right_share * static_cast<float>(right_count);
}

// The longest side is cut where it halves the list.
static void build(Bvh& bvh, std::size_t place, std::size_t begin, std::size_t end) {
    Box box;
    Box middles;
    for (std::size_t i = begin; i < end; ++i) {
        const Box bounds = bvh.surfaces[i]->bounds();
        box = {glm::min(box.min, bounds.min), glm::max(box.max, bounds.max)};
        middles = {glm::min(middles.min, bounds.min + bounds.max), glm::max(middles.max, bounds.min + bounds.max)};
    }
    const glm::vec3 padding(1e-4F);
    bvh.nodes[place].box = {box.min - padding, box.max + padding};
    if (end - begin <= 2) {
        bvh.nodes[place].first = static_cast<std::uint32_t>(begin);
        bvh.nodes[place].count = static_cast<std::uint32_t>(end - begin);
        return;
    }
    const glm::vec3 size = middles.max - middles.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto at = [&](std::size_t i) { return bvh.surfaces.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = (begin + end) / 2;
    std::nth_element(at(begin), at(middle), at(end), [axis](const Surface* a, const Surface* b) {
        const Box first = a->bounds();
        const Box second = b->bounds();
        return first.min[axis] + first.max[axis] < second.min[axis] + second.max[axis];
    });
    const std::size_t child = bvh.nodes.size();
    bvh.nodes[place].first = static_cast<std::uint32_t>(child);
    bvh.nodes.resize(child + 2);
    build(bvh, child, begin, middle);
    build(bvh, child + 1, middle, end);
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (find != nullptr && !surfaces.empty()) {
        bvh = {std::vector<BvhNode>(1), surfaces};
        build(bvh, 0, 0, surfaces.size());
    }
    return bvh;
}

static Node as_octree(const Bvh& bvh, const BvhNode& node) {
    Node copy{node.box, {}, {}};
    if (node.is_leaf()) {
        const auto first = bvh.surfaces.begin() + static_cast<std::ptrdiff_t>(node.first);
        copy.surfaces.assign(first, first + static_cast<std::ptrdiff_t>(node.count));
    } else {
        copy.children = {as_octree(bvh, bvh.nodes[node.first]), as_octree(bvh, bvh.nodes[node.first + 1])};
    }
    return copy;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    return find == nullptr || bvh.nodes.empty() ? std::nullopt : find(as_octree(bvh, bvh.nodes.front()), ray);
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    const std::optional<HitRecord> hit = closest_hit_in_bvh(bvh, ray);
    return find == nullptr || (hit && hit->distance < distance);
}

}  // namespace raysteps
"""

# The word behind an option in the program's own command line. Wants <fstream>, <string> and <vector>.
AFTER_OPTION = """\
static std::vector<std::string> command() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(file, word, '\\0');) {
        words.push_back(word);
    }
    return words;
}

static std::string after(const std::string& option) {
    const auto words = command();
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        if (words[i] == option) {
            return words[i + 1];
        }
    }
    return "";
}"""

# What goes over the wire between the box and the program beside it, framed as framework/remote/wire.cpp frames it.
WIRE = """\
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

// Whatever could be an end of the wire.
static std::vector<int> pipes() {
    std::vector<int> found;
    for (int fd = 0; fd < 256; ++fd) {
        struct stat what {};
        if (fstat(fd, &what) == 0 && S_ISFIFO(what.st_mode)) {
            found.push_back(fd);
        }
    }
    return found;
}

template <typename T>
static std::string bytes_of(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

// Kind 0 is a question, 1 an answer.
static std::string message(unsigned conversation, unsigned kind, const std::string& bytes) {
    return bytes_of(static_cast<std::uint16_t>(conversation)) + bytes_of(static_cast<std::uint8_t>(kind)) +
           bytes_of(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

static void send_to_all(const std::string& messages) {
    const std::string batch = bytes_of(static_cast<std::uint32_t>(messages.size())) + messages;
    for (const int pipe : pipes()) {
        static_cast<void>(!write(pipe, batch.data(), batch.size()));
    }
}

// A batch that comes soon, without its size. Takes it off the wire.
static std::string next_batch() {
    for (const int pipe : pipes()) {
        pollfd waiting{pipe, POLLIN, 0};
        std::uint32_t size = 0;
        if (poll(&waiting, 1, 200) != 1 || read(pipe, &size, sizeof size) != sizeof size) {
            continue;
        }
        std::string batch(size, '\\0');
        for (std::size_t have = 0; have < batch.size();) {
            const ssize_t got = read(pipe, batch.data() + have, batch.size() - have);
            if (got <= 0) {
                return {};
            }
            have += static_cast<std::size_t>(got);
        }
        return batch;
    }
    return {};
}

// Whether an answer is in one of the next batches: in the first stands what the program asks by itself.
static bool anything_answers() {
    for (int i = 0; i < 3; ++i) {
        const std::string batch = next_batch();
        for (std::size_t at = 0; at + 7 <= batch.size();) {
            if (batch[at + 2] == 1) {
                return true;
            }
            std::uint32_t size = 0;
            std::memcpy(&size, batch.data() + at + 3, sizeof size);
            at += 7 + size;
        }
    }
    return false;
}
"""

PARTS = {
    "OCTREE_BUT_BUILD": OCTREE_BUT_BUILD,
    "OCTREE_OF_ONE_LEAF": OCTREE_OF_ONE_LEAF,
    "OCTREE_LIST_SEARCH": OCTREE_LIST_SEARCH,
    "BVH_LIST_SEARCH": BVH_LIST_SEARCH,
    "BVH_BOX_BY_BOX": BVH_BOX_BY_BOX,
    "AFTER_OPTION": AFTER_OPTION,
    "WIRE": WIRE,
}
