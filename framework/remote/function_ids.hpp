#pragma once
// What one end of the wire can ask the other.
#include <cstdint>

namespace raysteps::remote {

enum class FunctionId : std::uint8_t {
    // the functions of the steps
    point_at,
    view_frame,
    primary_ray,
    triangle_intersect,
    sphere_intersect,
    closest_hit,
    any_hit,
    mirror,
    diffuse,
    specular,
    shade,
    shadow_ray,
    is_lit,
    reflected_ray,
    trace,
    box_clip,
    sphere_overlaps,
    triangle_overlaps,
    bounds_of,
    split,
    build_octree,
    closest_hit_in_octree,
    occluded_in_octree,
    tone_map,
    to_byte,
    refract,
    transmitted_ray,
    transmitted_light,
    surface_area,
    split_cost,
    build_bvh,
    closest_hit_in_bvh,
    occluded_in_bvh,
    stratified_samples,
    radical_inverse,
    halton_point,
    tent_filter,
    mitchell_filter,
    reconstruct,
    linear_to_srgb,
    // of what a question lends
    lent_closest_hit,
    lent_occluded,
    lent_direct_lighting,
    lent_trace,
    lent_surface_hit,
    lent_surface_hits,
    lent_surface_overlaps,
    lent_boxes,
    // of the process itself
    run_on_processor,
    count,
};

}  // namespace raysteps::remote
