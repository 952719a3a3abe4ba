#pragma once
// The terms of a hit's light, asked from the steps' functions one by one.
#include "inspect/pixel_record.hpp"

namespace raysteps {

/// Fills in what the node's lights send to the hit, and their sum. Rays that were cast are kept. Nobody hears it.
void describe_lights(const Scene& scene, const StepOptions& options, const HitRecord& hit, RayNode& node);

/// What the steps' functions make of a hit: the point, and where a ray could go on. Nobody hears it.
void describe_hit(const StepOptions& options, const RayNode& node, HitTrace& trace);

}  // namespace raysteps
