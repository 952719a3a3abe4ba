#pragma once
// Textures from PNG and JPEG files.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/texture.hpp"

namespace raysteps {

/// What a file holds is meant for a screen: it is bent by sRGB's curve, and straightened here unless it is `linear`
/// already. All throw ReadError for a file that is no picture, or is larger than 8192 x 8192.
[[nodiscard]] Texture read_texture(const std::filesystem::path& path, bool linear);
[[nodiscard]] Texture read_texture(std::string_view bytes, const std::string& name, bool linear);

/// What stands in a name such as `data:image/png;base64,iVBORw0...` (RFC 2397 and 4648, padded with `=`); nothing where
/// it is none, or was cut off within four digits.
[[nodiscard]] std::optional<std::string> bytes_of_data_uri(std::string_view uri);

}  // namespace raysteps
