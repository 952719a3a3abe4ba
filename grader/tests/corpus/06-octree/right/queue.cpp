// Best first: a priority queue over all boxes, nearest entry on top.
#include "steps/06-octree/octree.hpp"

#include "core/rounding.hpp"

#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

namespace raysteps {

Box bounds_of(const SurfaceList& surfaces) {
    return std::accumulate(surfaces.begin(), surfaces.end(), Box{}, [](Box sum, const Surface* surface) {
        sum.extend(surface->bounds());
        return sum;
    });
}

std::array<Box, 8> split(const Box& box) {
    const auto& [lo, hi] = std::tie(box.min, box.max);
    const glm::vec3 m = box.center();
    return {{
        Box{{lo.x, lo.y, lo.z}, {m.x, m.y, m.z}},
        Box{{m.x, lo.y, lo.z}, {hi.x, m.y, m.z}},
        Box{{lo.x, m.y, lo.z}, {m.x, hi.y, m.z}},
        Box{{m.x, m.y, lo.z}, {hi.x, hi.y, m.z}},
        Box{{lo.x, lo.y, m.z}, {m.x, m.y, hi.z}},
        Box{{m.x, lo.y, m.z}, {hi.x, m.y, hi.z}},
        Box{{lo.x, m.y, m.z}, {m.x, hi.y, hi.z}},
        Box{{m.x, m.y, m.z}, {hi.x, hi.y, hi.z}},
    }};
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    constexpr float inf = std::numeric_limits<float>::infinity();
    glm::vec3 in(-inf);
    glm::vec3 out(inf);
    for (int i = 0; i < 3; ++i) {
        if (ray.direction[i] != 0.0F) {
            const float a = (min[i] - ray.origin[i]) / ray.direction[i];
            const float b = (max[i] - ray.origin[i]) / ray.direction[i];
            in[i] = ray.direction[i] > 0.0F ? a : b;
            out[i] = ray.direction[i] > 0.0F ? b : a;
        } else if (!(min[i] <= ray.origin[i] && ray.origin[i] <= max[i])) {
            return std::nullopt;
        }
    }
    const float enter = glm::max(0.0F, glm::max(in.x, glm::max(in.y, in.z)));
    const float leave = glm::min(out.x, glm::min(out.y, out.z));
    return enter <= leave ? std::optional<Interval>(Interval{enter, leave}) : std::nullopt;
}

bool Sphere::overlaps(const Box& box) const {
    const glm::vec3 nearest = glm::max(box.min, glm::min(center(), box.max));
    return glm::distance(nearest, center()) <= radius() * 1.0001F;
}

bool Triangle::overlaps(const Box& box) const {
    const Box own = bounds();
    const glm::vec3 low = glm::max(own.min, box.min);
    const glm::vec3 high = glm::min(own.max, box.max);
    return low.x <= high.x && low.y <= high.y && low.z <= high.z;
}

Node build_octree(const SurfaceList& surfaces) {
    std::function<Node(const Box&, const SurfaceList&, int)> grow = [&grow](const Box& box, const SurfaceList& list,
                                                                            int levels_left) -> Node {
        Node node{box, {}, {}};
        if (levels_left == 0 || list.size() <= 4) {
            node.surfaces = list;
            return node;
        }
        for (const Box& part : split(box)) {
            SurfaceList some;
            for (const Surface* surface : list) {
                if (surface->overlaps(part)) {
                    some.push_back(surface);
                }
            }
            node.children.push_back(grow(part, some, levels_left - 1));  // empty ones, too: all eight
        }
        return node;
    };
    Box box = bounds_of(surfaces);
    if (!surfaces.empty()) {
        box = box.padded(padding_within(box));
    }
    return grow(box, surfaces, 3);
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    using Entry = std::pair<float, const Node*>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::optional<HitRecord> best;
    const Surface* owner = nullptr;

    if (const auto part = root.box.hit(ray)) {
        queue.emplace(part->enter, &root);
    }
    while (!queue.empty()) {
        const auto [enter, node] = queue.top();
        queue.pop();
        if (best && enter * (1.0F - k_distance_slack) > best->distance) {
            break;
        }
        for (const Surface* surface : node->surfaces) {
            if (const auto hit = surface->hit(ray)) {
                if (!best || std::make_tuple(hit->distance, surface->order()) <
                                 std::make_tuple(best->distance, owner->order())) {
                    best = hit;
                    owner = surface;
                }
            }
        }
        for (const Node& child : node->children) {
            if (const auto part = child.box.hit(ray)) {
                queue.emplace(part->enter, &child);
            }
        }
    }
    return best;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    const auto part = root.box.hit(ray);
    if (!part || part->enter * (1.0F - k_distance_slack) > distance) {
        return false;
    }
    for (const Surface* surface : root.surfaces) {
        const auto hit = surface->hit(ray);
        if (hit.has_value() && hit->distance < distance) {
            return true;
        }
    }
    for (const Node& child : root.children) {
        if (occluded_in_octree(child, ray, distance)) {
            return true;
        }
    }
    return false;
}

}  // namespace raysteps
