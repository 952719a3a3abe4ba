#pragma once
// The mesh that a scene in pbrt's format holds itself: Shape "trianglemesh".
#include "io/mesh_data.hpp"
#include "io/pbrt_scanner.hpp"

namespace raysteps {

/// Throws ReadError where a list has another length than the others ask for, or names a corner that is not there.
[[nodiscard]] MeshData pbrt_mesh(const PbrtScanner& scanner, const PbrtParameters& parameters);

}  // namespace raysteps
