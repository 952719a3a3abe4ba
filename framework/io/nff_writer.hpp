#pragma once
// Scenes to NFF.
#include <string>

#include "core/scene.hpp"

namespace raysteps {

/// Text that read_nff turns into the same scene, number for number (the normals of a patch up to rounding, since
/// they are made unit length again). A surface of a type that NFF does not know becomes a comment.
[[nodiscard]] std::string write_nff(const Scene& scene);

/// The `v` block alone.
[[nodiscard]] std::string write_viewpoint(const Camera& camera);

}  // namespace raysteps
