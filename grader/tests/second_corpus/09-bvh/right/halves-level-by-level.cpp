// Half of the list along the longest axis, built level by level; searches by recursion. Leaves of one.
#include "steps/09-bvh/bvh.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

namespace raysteps {

float surface_area(const Box& box) {
    double sides[3];
    for (int i = 0; i < 3; ++i) {
        if (box.min[i] > box.max[i]) return 0.0F;
        sides[i] = double(box.max[i]) - double(box.min[i]);
    }
    return float(2.0 * sides[0] * sides[1] + 2.0 * sides[1] * sides[2] + 2.0 * sides[0] * sides[2]);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const double all = surface_area(whole);
    if (all <= 0.0) return k_two_box_tests + float(left_count + right_count);
    const double tests = double(left_count) * double(surface_area(left)) + double(right_count) * double(surface_area(right));
    return float(double(k_two_box_tests) + tests / all);
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    bvh.surfaces = surfaces;
    if (surfaces.empty()) return bvh;

    Box all;
    for (const Surface* s : surfaces) all.extend(s->bounds());
    const float padding = padding_within(all);

    struct Job {
        std::uint32_t place, begin, end;
    };
    bvh.nodes.push_back({});
    std::deque<Job> jobs{{0, 0, static_cast<std::uint32_t>(surfaces.size())}};
    while (!jobs.empty()) {
        const Job job = jobs.front();
        jobs.pop_front();
        BvhNode node;
        for (std::uint32_t i = job.begin; i < job.end; ++i) node.box.extend(bvh.surfaces[i]->bounds().padded(padding));
        if (job.end - job.begin == 1) {
            node.first = job.begin;
            node.count = 1;
        } else {
            const glm::vec3 size = node.box.max - node.box.min;
            int longest = 0;
            for (int i = 1; i < 3; ++i) longest = size[i] > size[longest] ? i : longest;
            const auto first = bvh.surfaces.begin();
            const std::uint32_t middle = job.begin + (job.end - job.begin) / 2;
            std::nth_element(first + job.begin, first + middle, first + job.end,
                             [longest](const Surface* a, const Surface* b) {
                                 return std::pair(a->bounds().center()[longest], a->order()) <
                                        std::pair(b->bounds().center()[longest], b->order());
                             });
            node.first = static_cast<std::uint32_t>(bvh.nodes.size());
            jobs.push_back({node.first, job.begin, middle});
            jobs.push_back({node.first + 1, middle, job.end});
            bvh.nodes.resize(bvh.nodes.size() + 2);
        }
        bvh.nodes[job.place] = node;
    }
    return bvh;
}

namespace {

struct Winner {
    std::optional<HitRecord> hit;
    std::size_t order = 0;
};

bool too_far(float enter, const Winner& winner) {
    return winner.hit && enter > winner.hit->distance * (1.0F + k_distance_slack);
}

void search(const Bvh& bvh, std::uint32_t place, const Ray& ray, Winner& winner) {
    const BvhNode& node = bvh.nodes[place];
    if (node.is_leaf()) {
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const Surface* s = bvh.surfaces[node.first + i];
            const auto hit = s->hit(ray);
            if (!hit) continue;
            if (!winner.hit || std::pair(hit->distance, s->order()) < std::pair(winner.hit->distance, winner.order)) {
                winner = {hit, s->order()};
            }
        }
        return;
    }
    const auto a = bvh.nodes[node.first].box.hit(ray);
    const auto b = bvh.nodes[node.first + 1].box.hit(ray);
    const bool b_is_nearer = a && b && b->enter < a->enter;
    if (b && b_is_nearer && !too_far(b->enter, winner)) search(bvh, node.first + 1, ray, winner);
    if (a && !too_far(a->enter, winner)) search(bvh, node.first, ray, winner);
    if (b && !b_is_nearer && !too_far(b->enter, winner)) search(bvh, node.first + 1, ray, winner);
}

bool blocked(const Bvh& bvh, std::uint32_t place, const Ray& ray, float distance) {
    const BvhNode& node = bvh.nodes[place];
    const auto part = node.box.hit(ray);
    if (!part || part->enter > distance) return false;
    if (!node.is_leaf()) {
        return blocked(bvh, node.first, ray, distance) || blocked(bvh, node.first + 1, ray, distance);
    }
    const auto begin = bvh.surfaces.begin() + node.first;
    return std::any_of(begin, begin + node.count, [&](const Surface* s) {
        const auto hit = s->hit(ray);
        return hit && hit->distance < distance;
    });
}

}  // namespace

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    Winner winner;
    if (!bvh.nodes.empty() && bvh.nodes[0].box.hit(ray)) search(bvh, 0, ray, winner);
    return winner.hit;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    return !bvh.nodes.empty() && blocked(bvh, 0, ray, distance);
}

}  // namespace raysteps
