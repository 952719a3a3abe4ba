#pragma once
// Textures from PNG and JPEG files.
#include <filesystem>
#include <string>
#include <string_view>

#include "core/texture.hpp"

namespace raysteps {

/// What a file holds is meant for a screen: it is bent by sRGB's curve, and straightened here unless it is `linear`
/// already. All throw ReadError for a file that is no picture, or is larger than 8192 x 8192.
[[nodiscard]] Texture read_texture(const std::filesystem::path& path, bool linear);
[[nodiscard]] Texture read_texture(std::string_view bytes, const std::string& name, bool linear);

}  // namespace raysteps
