#pragma once
// Scenes to NFF.
#include <string>

#include "core/scene.hpp"

namespace raysteps {

/// Text that read_nff turns into the same scene, number for number. A smooth triangle becomes a flat one, for the
/// kit's type does not give its normals away. A surface of any other type becomes a comment.
[[nodiscard]] std::string write_nff(const Scene& scene);

}  // namespace raysteps
