// No recursion in the search: a stack of boxes still to be visited.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raysteps {

namespace {

const int MAX_LEVEL = 4;
const size_t MAX_IN_LEAF = 3;

struct ToDo {
    const Node* node;
    float enter;
};

bool apart(float min1, float max1, float min2, float max2) { return max1 < min2 || max2 < min1; }

void subdivide(Node& node, int level) {
    if (node.surfaces.size() <= MAX_IN_LEAF || level == MAX_LEVEL) return;
    std::array<Box, 8> boxes = split(node.box);
    for (int i = 0; i < 8; i++) {
        Node child;
        child.box = boxes[i];
        for (size_t j = 0; j < node.surfaces.size(); j++) {
            if (node.surfaces[j]->overlaps(child.box)) child.surfaces.push_back(node.surfaces[j]);
        }
        if (child.surfaces.size() > 0) node.children.push_back(child);
    }
    for (size_t i = 0; i < node.children.size(); i++) subdivide(node.children[i], level + 1);
    node.surfaces.clear();
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box b;
    for (size_t i = 0; i < surfaces.size(); i++) {
        Box s = surfaces[i]->bounds();
        for (int k = 0; k < 3; k++) {
            if (s.min[k] < b.min[k]) b.min[k] = s.min[k];
            if (s.max[k] > b.max[k]) b.max[k] = s.max[k];
        }
    }
    return b;
}

std::array<Box, 8> split(const Box& box) {
    float x[3] = {box.min.x, 0.5F * (box.min.x + box.max.x), box.max.x};
    float y[3] = {box.min.y, 0.5F * (box.min.y + box.max.y), box.max.y};
    float z[3] = {box.min.z, 0.5F * (box.min.z + box.max.z), box.max.z};
    std::array<Box, 8> result;
    int n = 0;
    for (int c = 0; c < 2; c++) {
        for (int b = 0; b < 2; b++) {
            for (int a = 0; a < 2; a++) {
                result[n].min = glm::vec3(x[a], y[b], z[c]);
                result[n].max = glm::vec3(x[a + 1], y[b + 1], z[c + 1]);
                n++;
            }
        }
    }
    return result;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    double tmin = 0.0;
    double tmax = INFINITY;
    for (int i = 0; i < 3; i++) {
        double lo = (double)min[i] - ray.origin[i];
        double hi = (double)max[i] - ray.origin[i];
        double d = ray.direction[i];
        if (lo > hi) return std::nullopt;
        if (d == 0) {
            if (lo > 0 || hi < 0) return std::nullopt;
        } else if (d > 0) {
            tmin = std::fmax(tmin, lo / d);
            tmax = std::fmin(tmax, hi / d);
        } else {
            tmin = std::fmax(tmin, hi / d);
            tmax = std::fmin(tmax, lo / d);
        }
    }
    if (tmax < tmin) return std::nullopt;
    return Interval{(float)tmin, (float)tmax};
}

bool Sphere::overlaps(const Box& box) const {
    double d2 = 0;
    for (int i = 0; i < 3; i++) {  // Arvo
        double c = center()[i];
        if (c < box.min[i]) d2 += (box.min[i] - c) * (box.min[i] - c);
        if (c > box.max[i]) d2 += (c - box.max[i]) * (c - box.max[i]);
    }
    return d2 <= 1.00001 * radius() * radius();
}

bool Triangle::overlaps(const Box& box) const {
    for (int i = 0; i < 3; i++) {
        float lo = std::min({a()[i], b()[i], c()[i]});
        float hi = std::max({a()[i], b()[i], c()[i]});
        if (apart(lo, hi, box.min[i], box.max[i])) return false;
    }
    return true;
}

Node build_octree(const SurfaceList& surfaces) {
    Node root;
    root.box = bounds_of(surfaces);
    root.surfaces = surfaces;
    subdivide(root, 1);
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<HitRecord> best;
    size_t bestOrder = 0;
    std::vector<ToDo> stack;
    if (auto part = root.box.hit(ray)) stack.push_back({&root, part->enter});
    while (!stack.empty()) {
        ToDo now = stack.back();
        stack.pop_back();
        if (best && now.enter > best->distance) continue;
        for (const Surface* s : now.node->surfaces) {
            auto h = s->hit(ray);
            if (!h) continue;
            bool better = !best || h->distance < best->distance;
            if (best && h->distance == best->distance) better = s->order() < bestOrder;
            if (better) {
                best = h;
                bestOrder = s->order();
            }
        }
        size_t from = stack.size();
        for (const Node& child : now.node->children) {
            if (auto part = child.box.hit(ray)) stack.push_back({&child, part->enter});
        }
        // the nearest on top
        std::sort(stack.begin() + from, stack.end(), [](ToDo p, ToDo q) { return p.enter > q.enter; });
    }
    return best;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    std::vector<const Node*> stack{&root};
    while (!stack.empty()) {
        const Node* node = stack.back();
        stack.pop_back();
        auto part = node->box.hit(ray);
        if (!part || part->enter > distance) continue;
        for (const Surface* s : node->surfaces) {
            auto h = s->hit(ray);
            if (h && h->distance < distance) return true;
        }
        for (const Node& child : node->children) stack.push_back(&child);
    }
    return false;
}

}  // namespace raysteps
