#pragma once
// Step 11 at work: the flat hits of a mesh get the normals, places and colours that the mesh says.
#include <memory>

#include "core/scene.hpp"
#include "render/accelerator.hpp"

namespace raysteps {

/// Whether this step adds details.
[[nodiscard]] bool adds_mesh_details(int step);

/// What finds hits in the scene, with their details where this step asks for them. The scene must outlive it. What a
/// picture costs stays the same: shadow rays, whose hits nobody looks at, get no details.
[[nodiscard]] std::unique_ptr<Accelerator> with_mesh_details(std::unique_ptr<Accelerator> inner, const Scene& scene,
                                                             int step);

}  // namespace raysteps
