// Trees and searches through them: steps 06 and 09.
#include <cstdint>

#include "core/stats.hpp"
#include "steps/06-octree/octree.hpp"
#include "steps/09-bvh/bvh.hpp"
#include "worker/counting_surfaces.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"
#include "worker/simple_bvh.hpp"
#include "worker/simple_octree.hpp"

namespace raysteps {
namespace {

void ask_bounds_of(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const Scene scene = read_surfaces(words, asked);
    write_box(answer, bounds_of(scene.surfaces()));
}

void ask_split(TokenReader& words, TokenWriter& answer) {
    for (const Box& part : split(read_box(words))) {
        write_box(answer, part);
    }
}

void ask_build_octree(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const Scene scene = read_surfaces(words, asked);
    write_tree(answer, build_octree(scene.surfaces()), scene.surfaces());
}

void ask_surface_area(TokenReader& words, TokenWriter& answer) { answer.number(surface_area(read_box(words))); }

void ask_split_cost(TokenReader& words, TokenWriter& answer) {
    const Box left = read_box(words);
    const auto left_count = static_cast<std::size_t>(words.count());
    const Box right = read_box(words);
    const auto right_count = static_cast<std::size_t>(words.count());
    answer.number(split_cost(left, left_count, right, right_count, read_box(words)));
}

void ask_build_bvh(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const Scene scene = read_surfaces(words, asked);
    write_bvh(answer, build_bvh(scene.surfaces()), scene.surfaces());
}

std::vector<Ray> read_rays(TokenReader& words) {
    std::vector<Ray> rays;
    for (int left = words.count(); left > 0; --left) {
        rays.push_back(read_ray(words));
    }
    return rays;
}

/// A ray up to a distance.
struct Reach {
    Ray ray;
    float distance;
};

std::vector<Reach> read_reaches(TokenReader& words) {
    std::vector<Reach> reaches;
    for (int left = words.count(); left > 0; --left) {
        const Ray ray = read_ray(words);
        reaches.push_back({ray, words.number()});
    }
    return reaches;
}

void write_found(TokenWriter& answer, const std::optional<HitRecord>& hit) { write_hit(answer, hit); }
void write_found(TokenWriter& answer, bool hit) { answer.flag(hit); }

// For each ray the surfaces asked, and what was found. A search that calls one that is not written, or wrong, is
// answered by the reference's, which goes through copies of the surfaces: then what the program counts is told.
template <class Item, class Search>
void search_for_each(const std::vector<Item>& items, const TestCounter& asked, TokenWriter& answer, Search search) {
    for (const Item& item : items) {
        const long long before = asked.times;
        const std::uint64_t counted = thread_stats().surface_tests;
        const auto found = search(item);
        const long long times = asked.times - before;
        answer.whole(times > 0 ? times : static_cast<long long>(thread_stats().surface_tests - counted));
        write_found(answer, found);
    }
}

Node make_octree(bool own, const SurfaceList& surfaces) { return own ? build_octree(surfaces) : simple_tree(surfaces); }

Bvh make_bvh(bool own, const SurfaceList& surfaces) { return own ? build_bvh(surfaces) : simple_bvh(surfaces); }

// All four: whose tree (1: of the step's own build function), surfaces, rays.
void ask_closest_hit_in_octree(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const bool own = words.flag();
    const Scene scene = read_surfaces(words, asked);
    const std::vector<Ray> rays = read_rays(words);
    const Node root = make_octree(own, scene.surfaces());
    search_for_each(rays, asked, answer, [&](const Ray& ray) { return closest_hit_in_octree(root, ray); });
}

// A distance at the end counts for all rays.
void ask_occluded_in_octree(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const bool own = words.flag();
    const Scene scene = read_surfaces(words, asked);
    const std::vector<Ray> rays = read_rays(words);
    const float distance = words.number();
    const Node root = make_octree(own, scene.surfaces());
    search_for_each(rays, asked, answer, [&](const Ray& ray) { return occluded_in_octree(root, ray, distance); });
}

void ask_closest_hit_in_bvh(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const bool own = words.flag();
    const Scene scene = read_surfaces(words, asked);
    const std::vector<Ray> rays = read_rays(words);
    const Bvh bvh = make_bvh(own, scene.surfaces());
    search_for_each(rays, asked, answer, [&](const Ray& ray) { return closest_hit_in_bvh(bvh, ray); });
}

// Each ray has its own distance.
void ask_occluded_in_bvh(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const bool own = words.flag();
    const Scene scene = read_surfaces(words, asked);
    const std::vector<Reach> reaches = read_reaches(words);
    const Bvh bvh = make_bvh(own, scene.surfaces());
    search_for_each(reaches, asked, answer,
                    [&](const Reach& reach) { return occluded_in_bvh(bvh, reach.ray, reach.distance); });
}

}  // namespace

void add_trees(FunctionTable& functions) {
    functions["bounds_of"] = ask_bounds_of;
    functions["split"] = ask_split;
    functions["build_octree"] = ask_build_octree;
    functions["closest_hit_in_octree"] = ask_closest_hit_in_octree;
    functions["occluded_in_octree"] = ask_occluded_in_octree;
    functions["surface_area"] = ask_surface_area;
    functions["split_cost"] = ask_split_cost;
    functions["build_bvh"] = ask_build_bvh;
    functions["closest_hit_in_bvh"] = ask_closest_hit_in_bvh;
    functions["occluded_in_bvh"] = ask_occluded_in_bvh;
}

}  // namespace raysteps
