#pragma once
// Pictures from and to PPM (netpbm's portable pixmap).
#include <filesystem>
#include <string>
#include <string_view>

#include "core/image.hpp"
#include "io/files.hpp"

namespace raysteps {

/// Reads P3 (text) and P6 (binary) of 1 x 1 to 16384 x 16384 pixels. A maxval other than 255 is scaled to it, with
/// rounding. After the pixels only white space may follow. Throws ReadError.
[[nodiscard]] Image read_ppm(const std::filesystem::path& path);

/// `name` stands for the file in messages.
[[nodiscard]] Image read_ppm(std::string_view bytes, const std::string& name);

/// The picture as a P6 file.
[[nodiscard]] std::string ppm_bytes(const Image& image);

}  // namespace raysteps
