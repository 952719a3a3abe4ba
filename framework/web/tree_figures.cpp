// Steps 06 and 09: boxes around surfaces.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "core/scene.hpp"
#include "core/stats.hpp"
#include "figure_list.hpp"
#include "steps/06-octree/octree.hpp"
#include "steps/09-bvh/bvh.hpp"

namespace raysteps {
namespace {

constexpr int k_balls = 90;

/// Small balls, spread evenly and without order, in the box of the worked example of step 06.
Scene many_balls() {
    Scene scene;
    for (int i = 0; i < k_balls; ++i) {
        const auto at = static_cast<float>(i);
        const float x = 1.9F * (std::fmod(0.7549F * at, 1.0F) - 0.5F);
        const float z = 1.9F * (std::fmod(0.5698F * at, 1.0F) - 0.5F);
        scene.add(std::make_unique<Sphere>(glm::vec3(x, 0.0F, z), 0.03F, Fill{}));
    }
    return scene;
}

/// Each box that the ray enters, with its level and where it is entered.
void write_entered(const Node& node, int level, const Ray& ray, JsonWriter& json) {
    const std::optional<Interval> inside = node.box.clip(ray);
    if (!inside) {
        return;
    }
    json.begin_array().vector(node.box.min).vector(node.box.max).number(inside->enter);
    json.whole(static_cast<std::uint64_t>(level)).end_array();
    for (const Node& child : node.children) {
        write_entered(child, level + 1, ray, json);
    }
}

void write_box(const Box& box, JsonWriter& json) { json.begin_array().vector(box.min).vector(box.max).end_array(); }

/// The two heaps of the worked example of step 09: nine boxes and one, of which the reader moves the last.
std::array<Box, 10> two_heaps(float last) {
    const auto box = [](float x, float x1, float y, float y1) { return Box{{x, y, 0.0F}, {x1, y1, 2.0F}}; };
    return {box(0.0F, 0.2F, 0.0F, 0.8F),       box(0.05F, 0.3F, 1.2F, 1.9F), box(0.1F, 0.4F, 0.3F, 1.0F),
            box(0.2F, 0.6F, 1.1F, 1.7F),       box(0.0F, 1.0F, 0.0F, 2.0F),  box(0.25F, 0.95F, 0.2F, 0.6F),
            box(0.5F, 0.8F, 1.3F, 1.8F),       box(0.6F, 0.9F, 0.7F, 1.2F),  box(0.7F, 1.0F, 0.1F, 0.9F),
            box(last - 1.0F, last, 0.0F, 2.0F)};
}

struct Cut {
    Box left;
    Box right;
    std::size_t left_count = 0;
    std::size_t right_count = 0;
};

/// Left are the boxes whose middle lies left of x.
Cut cut_at(float x, const std::array<Box, 10>& boxes) {
    Cut cut;
    for (const Box& box : boxes) {
        const bool is_left = box.center().x < x;
        (is_left ? cut.left : cut.right).extend(box);
        ++(is_left ? cut.left_count : cut.right_count);
    }
    return cut;
}

float cost_of(const Cut& cut, const Box& whole) {
    return split_cost(cut.left, cut.left_count, cut.right, cut.right_count, whole);
}

}  // namespace

/// x and z of where the ray starts, x and z of where it is aimed at.
void octree_figure(Numbers numbers, JsonWriter& json) {
    Ray ray;
    ray.origin.x = numbers.next();
    ray.origin.z = numbers.next();
    const float x = numbers.next();
    const glm::vec3 aim{x, 0.0F, numbers.next()};
    if (aim != ray.origin) {
        ray.direction = glm::normalize(aim - ray.origin);
    }
    const Scene scene = many_balls();
    const Node root = build_octree(scene.surfaces());
    thread_stats() = {};
    const std::optional<HitRecord> hit = closest_hit_in_octree(root, ray);
    const Stats tests = thread_stats();
    const std::optional<Interval> inside = Box{glm::vec3(-1.0F), glm::vec3(1.0F)}.clip(ray);
    json.key("direction").vector(ray.direction);
    json.key("enter").number(inside ? inside->enter : -1.0F).key("leave").number(inside ? inside->leave : -1.0F);
    json.key("distance").number(hit ? hit->distance : -1.0F);
    json.key("boxTests").whole(tests.box_tests).key("surfaceTests").whole(tests.surface_tests);
    json.key("balls").begin_array();
    for (const Surface* surface : scene.surfaces()) {
        json.vector(surface->bounds().center());
    }
    json.end_array();
    json.key("entered").begin_array();
    write_entered(root, 0, ray, json);
    json.end_array();
}

/// x of the cut, and where the last box ends.
void cuts_figure(Numbers numbers, JsonWriter& json) {
    constexpr int k_places = 41;
    const float x = numbers.next();
    const std::array<Box, 10> boxes = two_heaps(numbers.next());
    Box whole;
    for (const Box& box : boxes) {
        whole.extend(box);
    }
    const Cut cut = cut_at(x, boxes);
    json.key("area").number(surface_area(whole)).key("cost").number(cost_of(cut, whole));
    json.key("leftArea").number(surface_area(cut.left)).key("rightArea").number(surface_area(cut.right));
    json.key("leftCount").whole(cut.left_count).key("rightCount").whole(cut.right_count);
    json.key("left");
    write_box(cut.left, json);
    json.key("right");
    write_box(cut.right, json);
    json.key("boxes").begin_array();
    for (const Box& box : boxes) {
        write_box(box, json);
    }
    json.end_array();
    json.key("costs").begin_array();  // of cuts from x = 0 to x = 4
    for (int place = 0; place < k_places; ++place) {
        json.number(cost_of(cut_at(4.0F * static_cast<float>(place) / (k_places - 1), boxes), whole));
    }
    json.end_array();
}

}  // namespace raysteps
