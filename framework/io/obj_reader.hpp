#pragma once
// Meshes from Wavefront OBJ files: `v`, `vn`, `vt` and `f`. Everything else, such as groups and materials, is skipped.
#include <filesystem>
#include <string>
#include <string_view>

#include "io/mesh_data.hpp"

namespace raysteps {

/// Faces with more than three corners are cut into triangles that all have the first corner. All throw ReadError when
/// the file is not what OBJ asks for.
[[nodiscard]] MeshData read_obj(const std::filesystem::path& path);
[[nodiscard]] MeshData read_obj(std::string_view text, const std::string& name);

}  // namespace raysteps
