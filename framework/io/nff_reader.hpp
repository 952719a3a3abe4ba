#pragma once
// Scenes from NFF 3.1, the format of Eric Haines' Standard Procedural Databases. See docs/formats.md.
#include <filesystem>
#include <string>
#include <string_view>

#include "core/scene.hpp"
#include "io/files.hpp"

namespace raysteps {

/// Both throw ReadError when the file cannot be read or is not what NFF asks for.
[[nodiscard]] Scene read_nff(const std::filesystem::path& path);

/// `name` stands for the file in messages.
[[nodiscard]] Scene read_nff(std::string_view text, const std::string& name);

}  // namespace raysteps
