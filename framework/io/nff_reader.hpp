#pragma once
// Scenes from NFF 3.1, the format of Eric Haines' Standard Procedural Databases. See docs/formats.md.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene.hpp"
#include "io/files.hpp"
#include "io/pbrt_reader.hpp"

namespace raysteps {

/// All throw ReadError when the file cannot be read or is not what NFF asks for.
[[nodiscard]] Scene read_nff(const std::filesystem::path& path);

/// A scene as it was typed, for a picture of this size; nothing: the size that the scene names. NFF, or pbrt's format
/// where a line begins with `WorldBegin`.
[[nodiscard]] Scene load_scene(std::string_view path, const std::optional<PictureSize>& size);

/// `name` stands for the file in messages.
[[nodiscard]] Scene read_nff(std::string_view text, const std::string& name);

}  // namespace raysteps
