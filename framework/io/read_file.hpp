#pragma once
// A whole file as bytes.
#include <filesystem>
#include <string>

namespace raysteps {

/// Throws ReadError for a directory, a file that cannot be opened or read, and one above 1 GiB.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// The path as messages name it, in UTF-8.
[[nodiscard]] std::string display_name(const std::filesystem::path& path);

}  // namespace raysteps
