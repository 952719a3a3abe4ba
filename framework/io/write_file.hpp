#pragma once
// Writes a file whole or not at all.
#include <filesystem>
#include <string_view>

namespace raysteps {

/// Writes to a temporary name in the same folder, then renames, so that nobody ever sees half a file. An existing
/// file is replaced; a link is followed; a device or pipe (/dev/null) is written to directly.
/// Throws std::runtime_error, and then nothing is left behind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace raysteps
