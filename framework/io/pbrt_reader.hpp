#pragma once
// Scenes of part two, in a small part of the format of pbrt (Pharr, Jakob and Humphreys). See docs/formats.md.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene.hpp"

namespace raysteps {

/// In pixels.
struct PictureSize {
    int width = 0;
    int height = 0;
};

/// All throw ReadError when the file, or one that it names, cannot be read or is not what is asked for.
[[nodiscard]] Scene read_pbrt(const std::filesystem::path& path);

/// The same of a file whose text was read before: a pipe gives it only once. With a size, the picture has that one, and
/// `fov` is that of its shorter side.
[[nodiscard]] Scene read_pbrt_file(std::string_view text, const std::filesystem::path& path,
                                   const std::optional<PictureSize>& size = std::nullopt);

/// `name` stands for the file in messages. A text that names other files is refused.
[[nodiscard]] Scene read_pbrt(std::string_view text, const std::string& name);

}  // namespace raysteps
