#include "inspect/lost_hit.hpp"

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
bool loses_space(const SurfaceList& surfaces, const glm::vec3& point, LostHit& lost) {
    constexpr int k_levels = 4;
    Box box = bounds_of(surfaces);
    lost.box = box;
    lost.reason = LossReason::no_bounds;
    if (!contains(box, point)) {
        return true;
    }
    lost.reason = LossReason::no_part;
    for (int level = 0; level < k_levels; ++level) {
        const std::array<Box, 8> parts = split(box);
        const auto part =
            std::find_if(parts.begin(), parts.end(), [&](const Box& one) { return contains(one, point); });
        if (part == parts.end()) {
            lost.box = box;
            return true;
        }
        box = *part;
    }
    return false;
}

/// What the boxes around the lost point have to say, the worst fault first.
class LostHitDiagnosis {
public:
    LostHitDiagnosis(const Surface& surface, const glm::vec3& point, const SearchRecorder& recorder)
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

    void conclude(LostHit& lost) const {
        if (!any_) {
            lost.reason = LossReason::not_tested;
        } else if (missed_) {
            lost.reason = LossReason::box_missed;
            lost.box = missed_;
        } else if (listing_) {
            lost.reason = entered_ ? LossReason::not_tested : LossReason::not_visited;
            lost.box = listing_;
        } else if (around_) {
            lost.reason = overlaps_all() ? LossReason::not_listed : LossReason::no_overlap;
            lost.box = around_;
        } else {
            lost.reason = LossReason::no_box;
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
    const SearchRecorder& recorder_;
    bool any_ = false;
    bool entered_ = false;
    std::optional<Box> missed_;
    std::optional<Box> listing_;
    std::optional<Box> around_;
};

}  // namespace

std::optional<LostHit> find_lost_hit(const RayNode& node, float limit, const SurfaceList& surfaces,
                                     const Accelerator& accelerator, const SearchRecorder& recorder) {
    const RecorderPause unheard;
    const Nearest nearest = nearest_of(surfaces, node.ray);
    if (nearest.surface == nullptr || !(nearest.hit.distance < limit)) {
        return std::nullopt;
    }
    if (node.hit && node.hit->hit.distance <= nearest.hit.distance * (1.0F + k_as_near)) {
        return std::nullopt;
    }
    LostHit lost{.surface = nearest.surface->order(),
                 .kind = describe(*nearest.surface).kind,
                 .distance = nearest.hit.distance,
                 .reason = LossReason::not_chosen,
                 .box = std::nullopt};
    if (!recorder.asked(*nearest.surface)) {
        const glm::vec3 point = node.ray.origin + nearest.hit.distance * node.ray.direction;
        LostHitDiagnosis diagnosis(*nearest.surface, point, recorder);
        accelerator.visit_nodes(nearest.surface, [&](const NodeInfo& place) { diagnosis.look_at(place); });
        diagnosis.conclude(lost);
        const bool by_building = lost.reason == LossReason::no_box || lost.reason == LossReason::not_listed;
        LostHit deeper = lost;
        if (by_building && loses_space(surfaces, point, deeper)) {
            return deeper;
        }
    }
    return lost;
}

}  // namespace raysteps
