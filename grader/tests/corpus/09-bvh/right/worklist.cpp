// No recursion anywhere: a queue of jobs builds the tree, a priority queue searches it.
#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace raysteps {

float surface_area(const Box& box) {
    const bool empty = !(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z);
    const glm::vec3 s = empty ? glm::vec3(0.0F) : box.max - box.min;
    return 2 * s.x * s.y + 2 * s.y * s.z + 2 * s.z * s.x;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    float l = 1.0F;
    float r = 1.0F;
    if (const float w = surface_area(whole); w > 0) {
        l = surface_area(left) / w;
        r = surface_area(right) / w;
    }
    return k_two_box_tests + l * left_count + r * right_count;
}

Bvh build_bvh(const SurfaceList& surfaces) {
    struct Job {
        std::size_t node, begin, end;
    };
    Bvh bvh{{}, surfaces};
    std::queue<Job> jobs;
    if (!surfaces.empty()) {
        bvh.nodes.emplace_back();
        jobs.push({0, 0, surfaces.size()});
    }
    while (!jobs.empty()) {
        const Job job = jobs.front();
        jobs.pop();
        Box box;
        for (auto i = job.begin; i < job.end; ++i) box.extend(bvh.surfaces[i]->bounds());
        BvhNode done;
        done.box = box;
        if (job.end - job.begin == 1) {
            done.first = static_cast<std::uint32_t>(job.begin);
            done.count = 1;
        } else {
            const glm::vec3 d = box.max - box.min;
            const float size[3] = {d.x, d.y, d.z};
            const int axis = static_cast<int>(std::max_element(size, size + 3) - size);
            std::sort(bvh.surfaces.begin() + job.begin, bvh.surfaces.begin() + job.end,
                      [axis](const Surface* a, const Surface* b) {
                          const Box p = a->bounds();
                          const Box q = b->bounds();
                          return p.min[axis] + p.max[axis] < q.min[axis] + q.max[axis];
                      });
            const auto half = job.begin + (job.end - job.begin) / 2;
            done.first = static_cast<std::uint32_t>(bvh.nodes.size());
            jobs.push({bvh.nodes.size(), job.begin, half});
            jobs.push({bvh.nodes.size() + 1, half, job.end});
            bvh.nodes.resize(bvh.nodes.size() + 2);
        }
        bvh.nodes[job.node] = done;
    }
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    using Entry = std::pair<float, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
    const auto ask = [&](std::uint32_t node) {
        if (const auto part = bvh.nodes[node].box.hit(ray)) open.push({part->enter, node});
    };
    if (!bvh.nodes.empty()) ask(0);

    std::optional<HitRecord> best;
    std::size_t order = 0;
    while (!open.empty() && !(best && open.top().first > best->distance)) {
        const BvhNode& node = bvh.nodes[open.top().second];
        open.pop();
        if (!node.is_leaf()) {
            ask(node.first);
            ask(node.first + 1);
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const Surface& surface = *bvh.surfaces[node.first + i];
            const auto hit = surface.hit(ray);
            if (!hit) continue;
            const bool nearer = !best || hit->distance < best->distance;
            const bool tie = best && hit->distance == best->distance;
            if (nearer || (tie && surface.order() < order)) {
                best = hit;
                order = surface.order();
            }
        }
    }
    return best;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::queue<std::uint32_t> open;
    if (!bvh.nodes.empty()) open.push(0);
    for (; !open.empty(); open.pop()) {
        const BvhNode& node = bvh.nodes[open.front()];
        const auto part = node.box.hit(ray);
        if (!part || part->enter >= distance) continue;
        if (!node.is_leaf()) {
            open.push(node.first);
            open.push(node.first + 1);
        }
        for (auto i = node.first; i < node.first + node.count; ++i) {
            if (const auto hit = bvh.surfaces[i]->hit(ray); hit && hit->distance < distance) return true;
        }
    }
    return false;
}

}  // namespace raysteps
