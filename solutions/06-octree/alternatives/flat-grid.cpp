// No levels: a root with the cells of a regular grid as its leaves. Triangles are sorted in by cutting them off at the
// six planes of a cell (Sutherland and Hodgman). All cells that a ray meets are sorted by where it enters them and
// visited until one begins behind the closest hit; no surface is asked twice. The slab test divides and stops early.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace raysteps {
namespace {

using Polygon = std::vector<glm::dvec3>;

/// What is left of the polygon on one side of an axis-aligned plane.
Polygon cut_off(const Polygon& polygon, int axis, double limit, double side) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& from = polygon[i];
        const glm::dvec3& to = polygon[(i + 1) % polygon.size()];
        const double front_face = side * (from[axis] - limit);
        const double to_outside = side * (to[axis] - limit);
        if (front_face <= 0.0) {
            kept.push_back(from);
        }
        if ((front_face < 0.0 && to_outside > 0.0) || (front_face > 0.0 && to_outside < 0.0)) {
            kept.push_back(from + front_face / (front_face - to_outside) * (to - from));
        }
    }
    return kept;
}

/// All boxes below that have a list and are met by the ray. A grid has one level, a tree of other hands may have more.
void add_cells(const Node& node, const Ray& ray, std::vector<std::pair<float, const Node*>>& cells) {
    for (const Node& child : node.children) {
        if (const std::optional<Interval> part = child.box.hit(ray)) {
            cells.emplace_back(part->enter, &child);
            add_cells(child, ray, cells);
        }
    }
}

int cells_along_an_axis(std::size_t surfaces) {
    const double wanted = std::cbrt(2.0 * static_cast<double>(surfaces));
    return std::clamp(static_cast<int>(wanted), 1, 12);
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box all;
    for (const Surface* surface : surfaces) {
        all.extend(surface->bounds());
    }
    return all;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 middle = box.min + 0.5F * (box.max - box.min);
    const std::array<glm::vec3, 3> planes{box.min, middle, box.max};
    std::array<Box, 8> parts;
    for (std::size_t z = 0; z < 2; ++z) {
        for (std::size_t y = 0; y < 2; ++y) {
            for (std::size_t x = 0; x < 2; ++x) {
                parts[x + 2 * y + 4 * z] = {{planes[x].x, planes[y].y, planes[z].z},
                                            {planes[x + 1].x, planes[y + 1].y, planes[z + 1].z}};
            }
        }
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::infinity();
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
        enter = std::max(enter, first);
        leave = std::min(leave, second);
        if (enter > leave) {
            return std::nullopt;
        }
    }
    return Interval{enter, leave};
}

/// Arvo (1990): the squared distance from the centre to the box, one axis after the other.
bool Sphere::overlaps(const Box& box) const {
    double distance_squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double below = static_cast<double>(box.min[axis]) - static_cast<double>(center_[axis]);
        const double above = static_cast<double>(center_[axis]) - static_cast<double>(box.max[axis]);
        const double outside = std::max({below, above, 0.0});
        distance_squared += outside * outside;
    }
    return distance_squared <= 1.00001 * static_cast<double>(radius_) * static_cast<double>(radius_);
}

bool Triangle::overlaps(const Box& box) const {
    Polygon polygon{glm::dvec3(a_), glm::dvec3(b_), glm::dvec3(c_)};
    const double slack = 1e-6 * static_cast<double>(glm::length(box.max) + glm::length(box.min));
    for (int axis = 0; axis < 3 && !polygon.empty(); ++axis) {
        polygon = cut_off(polygon, axis, static_cast<double>(box.max[axis]) + slack, 1.0);
        polygon = cut_off(polygon, axis, static_cast<double>(box.min[axis]) - slack, -1.0);
    }
    return !polygon.empty();
}

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) {
        return {};
    }
    Box all = bounds_of(surfaces);
    const float slack = 1e-5F * (glm::length(all.min) + glm::length(all.max));
    all.min -= slack;
    all.max += slack;
    Node root{all, {}, {}};
    const int cells = cells_along_an_axis(surfaces.size());
    const glm::vec3 size = (all.max - all.min) / static_cast<float>(cells);
    for (int i = 0; i < cells * cells * cells; ++i) {
        const glm::vec3 place(i % cells, i / cells % cells, i / cells / cells);
        const glm::vec3 low = all.min + place * size;
        Node cell{{low - slack, low + size + slack}, {}, {}};
        for (const Surface* surface : surfaces) {
            if (surface->overlaps(cell.box)) {
                cell.surfaces.push_back(surface);
            }
        }
        if (!cell.surfaces.empty()) {
            root.children.push_back(std::move(cell));
        }
    }
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    if (!root.box.hit(ray)) {
        return std::nullopt;
    }
    std::vector<std::pair<float, const Node*>> cells;
    add_cells(root, ray, cells);
    cells.emplace_back(0.0F, &root);
    std::sort(cells.begin(), cells.end());
    SurfaceList asked;  // a large surface lies in many cells
    std::optional<HitRecord> closest;
    std::size_t order = 0;  // of the surface that was hit
    for (const auto& [enter, cell] : cells) {
        if (closest && closest->distance < 0.999F * enter) {
            break;
        }
        for (const Surface* surface : cell->surfaces) {
            if (std::find(asked.begin(), asked.end(), surface) != asked.end()) {
                continue;
            }
            asked.push_back(surface);
            const std::optional<HitRecord> hit = surface->hit(ray);
            const bool nearer = hit && (!closest || hit->distance < closest->distance);
            if (nearer || (hit && hit->distance == closest->distance && surface->order() < order)) {
                closest = hit;
                order = surface->order();
            }
        }
    }
    return closest;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    if (!root.box.hit(ray)) {
        return false;
    }
    std::vector<std::pair<float, const Node*>> cells{{0.0F, &root}};
    add_cells(root, ray, cells);
    SurfaceList asked;
    for (const auto& [enter, cell] : cells) {
        for (const Surface* surface : cell->surfaces) {
            if (std::find(asked.begin(), asked.end(), surface) != asked.end()) {
                continue;
            }
            asked.push_back(surface);
            if (const std::optional<HitRecord> hit = surface->hit(ray); hit && hit->distance < distance) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace raysteps
