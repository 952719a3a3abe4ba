#pragma once
// Meshes from PLY files (Turk 1994), as text or binary of either byte order.
#include <filesystem>
#include <string>
#include <string_view>

#include "io/mesh_data.hpp"

namespace raysteps {

/// Faces with more than three corners are cut into triangles that all have the first corner. Of a vertex x, y and z,
/// nx, ny and nz, and u and v (or s and t) count. All throw ReadError when the file is not what PLY asks for.
[[nodiscard]] MeshData read_ply(const std::filesystem::path& path);
[[nodiscard]] MeshData read_ply(std::string_view bytes, const std::string& name);

}  // namespace raysteps
