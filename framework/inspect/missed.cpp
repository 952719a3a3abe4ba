#include "inspect/missed.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "steps/06-octree/octree.hpp"

namespace raysteps {
namespace {

constexpr float k_as_near = 1e-5F;  // share of a distance within which two hits are the same

struct Nearest {
    const Surface* surface = nullptr;
    HitRecord hit;
};

Nearest nearest_of(const SurfaceList& surfaces, const Ray& ray) {
    Nearest nearest;
    for (const Surface* surface : surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && (nearest.surface == nullptr || hit->distance < nearest.hit.distance)) {
            nearest = {surface, *hit};
        }
    }
    return nearest;
}

bool contains(const Box& box, const glm::vec3& point) {
    const float slack = 1e-5F * (glm::length(point) + glm::distance(box.min, box.max));
    return box.padded(slack).contains(point);
}

/// Whether the functions that a tree is built with lose the point: bounds_of, or split again and again.
bool loses_space(const SurfaceList& surfaces, const glm::vec3& point, Missed& missed) {
    constexpr int k_levels = 4;
    Box box = bounds_of(surfaces);
    missed.box = box;
    missed.reason = MissReason::no_bounds;
    if (!contains(box, point)) {
        return true;
    }
    missed.reason = MissReason::no_part;
    for (int level = 0; level < k_levels; ++level) {
        const std::array<Box, 8> parts = split(box);
        const auto part =
            std::find_if(parts.begin(), parts.end(), [&](const Box& one) { return contains(one, point); });
        if (part == parts.end()) {
            missed.box = box;
            return true;
        }
        box = *part;
    }
    return false;
}

/// What the boxes around the lost point have to say, the worst fault first.
class Inquiry {
public:
    Inquiry(const Surface& surface, const glm::vec3& point, const Recorder& recorder)
        : surface_(surface), point_(point), recorder_(recorder) {}

    void look_at(const NodeInfo& place) {
        any_ = true;
        if (!contains(place.box, point_)) {
            return;
        }
        const auto asked = recorder_.asked_boxes().find(&place.box);
        if (asked != recorder_.asked_boxes().end() && !asked->second && !missed_) {
            missed_ = place.box;
        }
        if (place.lists_wanted) {
            listing_ = place.box;
            entered_ = entered_ || (asked != recorder_.asked_boxes().end() && asked->second);
        } else {
            around_ = place.box;  // the last one is the smallest, as boxes come before those within them
        }
    }

    [[nodiscard]] const glm::vec3& point() const { return point_; }

    void conclude(Missed& missed) const {
        if (!any_) {
            missed.reason = MissReason::not_tested;
        } else if (missed_) {
            missed.reason = MissReason::box_missed;
            missed.box = missed_;
        } else if (listing_) {
            missed.reason = entered_ ? MissReason::not_tested : MissReason::not_visited;
            missed.box = listing_;
        } else if (around_) {
            missed.reason = overlaps_all() ? MissReason::not_listed : MissReason::no_overlap;
            missed.box = around_;
        } else {
            missed.reason = MissReason::no_box;
        }
    }

private:
    /// Smaller and smaller boxes around the point, as a tree has them: the surface touches them all.
    [[nodiscard]] bool overlaps_all() const {
        Box box = *around_;
        for (int i = 0; i < 8; ++i) {
            if (!surface_.overlaps(box)) {
                return false;
            }
            box = {glm::mix(box.min, point_, 0.5F), glm::mix(box.max, point_, 0.5F)};
        }
        return true;
    }

    const Surface& surface_;
    glm::vec3 point_;
    const Recorder& recorder_;
    bool any_ = false;
    bool entered_ = false;
    std::optional<Box> missed_;
    std::optional<Box> listing_;
    std::optional<Box> around_;
};

}  // namespace

std::optional<Missed> find_missed(const RayNode& node, float limit, const SurfaceList& surfaces,
                                  const Accelerator& accelerator, const Recorder& recorder) {
    const Unheard unheard;
    const Nearest nearest = nearest_of(surfaces, node.ray);
    if (nearest.surface == nullptr || !(nearest.hit.distance < limit)) {
        return std::nullopt;
    }
    if (node.hit && node.hit->hit.distance <= nearest.hit.distance * (1.0F + k_as_near)) {
        return std::nullopt;
    }
    Missed missed{nearest.surface->order(), describe(*nearest.surface).kind, nearest.hit.distance,
                  MissReason::not_chosen, std::nullopt};
    if (!recorder.asked(*nearest.surface)) {
        Inquiry inquiry(*nearest.surface, node.ray.origin + nearest.hit.distance * node.ray.direction, recorder);
        accelerator.visit_nodes(nearest.surface, [&](const NodeInfo& place) { inquiry.look_at(place); });
        inquiry.conclude(missed);
        const bool by_building = missed.reason == MissReason::no_box || missed.reason == MissReason::not_listed;
        Missed deeper = missed;
        if (by_building && loses_space(surfaces, inquiry.point(), deeper)) {
            return deeper;
        }
    }
    return missed;
}

}  // namespace raysteps
