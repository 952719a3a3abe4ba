#pragma once
// Scenes of part two, in a small part of the format of pbrt (Pharr, Jakob and Humphreys). See docs/formats.md.
#include <filesystem>
#include <string>
#include <string_view>

#include "core/scene.hpp"

namespace raysteps {

/// All throw ReadError when the file, or one that it names, cannot be read or is not what is asked for.
[[nodiscard]] Scene read_pbrt(const std::filesystem::path& path);

/// The same of a file whose text was read before: a pipe gives it only once.
[[nodiscard]] Scene read_pbrt_file(std::string_view text, const std::filesystem::path& path);

/// `name` stands for the file in messages. A text that names other files is refused.
[[nodiscard]] Scene read_pbrt(std::string_view text, const std::string& name);

}  // namespace raysteps
