#pragma once
// Where a ray and a surface meet, with the surface's name and shape.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/surface.hpp"

namespace raysteps {

/// A surface as somebody else may draw it.
struct SurfaceInfo {
    std::size_t order = 0;
    std::string kind;               ///< sphere, hollow-sphere, triangle, smooth-triangle, cone, disk or other
    std::vector<glm::vec3> points;  ///< the centre of a sphere or disk, a triangle's corners, the ends of a cone
    std::vector<float> radii;       ///< of a sphere or disk, or of the ends of a cone
    Color color = k_black;
};

[[nodiscard]] SurfaceInfo describe(const Surface& surface);

struct HitTrace {
    HitRecord hit;
    std::optional<std::size_t> surface;  ///< nothing: no surface that was tested gave this hit
    std::string kind;
    glm::vec3 point{0.0F};               ///< step 01's point_at for the distance
    std::optional<glm::vec3> mirrored;   ///< from step 05 on: step 03's mirror of the ray
    std::optional<glm::vec3> refracted;  ///< from step 08 on, glass: step 08's refract of the ray; nothing: it cannot
};

/// Why a surface that the ray does meet was not found.
enum class LossReason {
    not_chosen,   ///< it was tested, and another hit was taken
    not_tested,   ///< a box that lists it was entered, but it was not asked
    box_missed,   ///< Box::clip says no to a box that holds the point
    not_visited,  ///< nobody asked the box that lists it
    not_listed,   ///< no box around the point lists it, though it overlaps such a box
    no_overlap,   ///< as before, and overlaps says no to the box
    no_box,       ///< no box around the point
    no_bounds,    ///< bounds_of all surfaces leaves the point out
    no_part,      ///< none of the parts that split makes of a box around the point holds it
};

/// What a search through all surfaces finds, where that is not what the structure found.
struct LostHit {
    std::size_t surface = 0;
    std::string kind;
    float distance = 0.0F;
    LossReason reason = LossReason::not_chosen;
    std::optional<Box> box;  ///< the one at fault
};

}  // namespace raysteps
