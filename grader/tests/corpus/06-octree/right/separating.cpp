// Precise overlap for triangles (separating axes); surfaces that touch all eight parts stay in the node.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>

namespace raysteps {

Box bounds_of(const SurfaceList& surfaces) {
    Box box;
    std::for_each(surfaces.begin(), surfaces.end(), [&box](const Surface* surface) { box.extend(surface->bounds()); });
    return box;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 corner[3] = {box.min, box.center(), box.max};
    std::array<Box, 8> parts;
    for (unsigned i = 0; i < parts.size(); ++i) {
        const unsigned x = i & 1U;
        const unsigned y = (i >> 1U) & 1U;
        const unsigned z = (i >> 2U) & 1U;
        parts[i].min = {corner[x].x, corner[y].y, corner[z].z};
        parts[i].max = {corner[x + 1].x, corner[y + 1].y, corner[z + 1].z};
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval t;
    for (int axis = 0; axis < 3; ++axis) {
        const float d = ray.direction[axis];
        if (d == 0.0F) {
            if (ray.origin[axis] < min[axis] || ray.origin[axis] > max[axis]) {
                return std::nullopt;
            }
        } else {
            const float near = d < 0.0F ? max[axis] : min[axis];
            const float far = d < 0.0F ? min[axis] : max[axis];
            t.enter = std::max(t.enter, (near - ray.origin[axis]) / d);
            t.leave = std::min(t.leave, (far - ray.origin[axis]) / d);
            if (t.enter > t.leave) {
                return std::nullopt;
            }
        }
    }
    return t;
}

bool Sphere::overlaps(const Box& box) const {
    const glm::dvec3 c(center());
    const glm::dvec3 q = glm::clamp(c, glm::dvec3(box.min), glm::dvec3(box.max));
    return glm::length(c - q) <= radius() + 1e-6 * (radius() + glm::length(c));
}

bool Triangle::overlaps(const Box& box) const {
    const glm::dvec3 middle = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
    const glm::dvec3 half = 0.5 * (glm::dvec3(box.max) - glm::dvec3(box.min));
    const glm::dvec3 v[3] = {glm::dvec3(a()) - middle, glm::dvec3(b()) - middle, glm::dvec3(c()) - middle};
    const glm::dvec3 edge[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    const double slack = 1e-6 * (glm::length(half) + glm::length(v[0]) + glm::length(v[1]) + glm::length(v[2]));

    const auto separates = [&](const glm::dvec3& axis) {
        const double p = glm::dot(axis, v[0]);
        const double q = glm::dot(axis, v[1]);
        const double r = glm::dot(axis, v[2]);
        const double reach = glm::dot(glm::abs(axis), half) + slack * glm::length(axis);
        return std::min({p, q, r}) > reach || std::max({p, q, r}) < -reach;
    };

    if (separates(glm::cross(edge[0], edge[1]))) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 unit(0.0);
        unit[i] = 1.0;
        if (separates(unit)) {
            return false;
        }
        for (const glm::dvec3& e : edge) {
            if (separates(glm::cross(unit, e))) {
                return false;
            }
        }
    }
    return true;
}

namespace {

void fill(Node& node, const SurfaceList& list, int level) {
    if (level == 5 || list.size() <= 4) {
        node.surfaces = list;
        return;
    }
    const std::array<Box, 8> parts = split(node.box);
    std::array<SurfaceList, 8> lists;
    for (const Surface* surface : list) {
        std::array<bool, 8> in{};
        for (std::size_t i = 0; i < 8; ++i) {
            in[i] = surface->overlaps(parts[i]);
        }
        const auto count = std::count(in.begin(), in.end(), true);
        if (count == 8 || count == 0) {
            node.surfaces.push_back(surface);  // it would only be copied eight times
            continue;
        }
        for (std::size_t i = 0; i < 8; ++i) {
            if (in[i]) {
                lists[i].push_back(surface);
            }
        }
    }
    for (std::size_t i = 0; i < 8; ++i) {
        if (!lists[i].empty()) {
            Node& child = node.children.emplace_back();
            child.box = parts[i];
            fill(child, lists[i], level + 1);
        }
    }
}

class Search {
public:
    explicit Search(const Ray& ray) : ray_(ray) {}

    void visit(const Node& node) {
        const std::optional<Interval> part = node.box.hit(ray_);
        if (!part || part->enter > limit()) {
            return;
        }
        for (const Surface* surface : node.surfaces) {
            keep(surface, surface->hit(ray_));
        }
        for (const Node& child : node.children) {
            visit(child);
        }
    }

    const std::optional<HitRecord>& best() const { return best_; }

private:
    float limit() const { return best_ ? best_->distance : std::numeric_limits<float>::infinity(); }

    void keep(const Surface* surface, const std::optional<HitRecord>& hit) {
        if (!hit || hit->distance > limit()) {
            return;
        }
        if (best_ && hit->distance == best_->distance && order_ < surface->order()) {
            return;
        }
        best_ = hit;
        order_ = surface->order();
    }

    const Ray& ray_;
    std::optional<HitRecord> best_;
    std::size_t order_ = 0;
};

}  // namespace

Node build_octree(const SurfaceList& surfaces) {
    Node root;
    root.box = bounds_of(surfaces);
    fill(root, surfaces, 1);
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    Search search(ray);
    search.visit(root);
    return search.best();
}

bool occluded_in_octree(const Node& node, const Ray& ray, float distance) {
    const std::optional<Interval> part = node.box.hit(ray);
    bool found = false;
    if (part && part->enter <= distance) {
        for (std::size_t i = 0; i < node.surfaces.size() && !found; ++i) {
            const std::optional<HitRecord> hit = node.surfaces[i]->hit(ray);
            found = hit && hit->distance < distance;
        }
        for (std::size_t i = 0; i < node.children.size() && !found; ++i) {
            found = occluded_in_octree(node.children[i], ray, distance);
        }
    }
    return found;
}

}  // namespace raysteps
