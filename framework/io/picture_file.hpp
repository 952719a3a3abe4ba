#pragma once
// Pictures as files.
#include <filesystem>
#include <string>

#include "core/image.hpp"

namespace raysteps {

/// The picture as a PNG file of 8 bits a channel, without loss.
[[nodiscard]] std::string png_bytes(const Image& image);

/// As write_file: PNG where the name ends in .png, in capitals or not, and else PPM.
void write_picture(const Image& image, const std::filesystem::path& path);

}  // namespace raysteps
