#pragma once
// Whole files: read, written, named, and what a reader throws when one is not what it should be.
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace raysteps {

/// what() reads `file:line:column: expected ..., found ...`; without line and column where the file could not
/// be read at all. Lines and columns count from 1, columns in bytes.
class ReadError : public std::runtime_error {
public:
    ReadError(std::string_view file, std::string_view expected, std::string_view found);
    ReadError(std::string_view file, std::size_t line, std::size_t column, std::string_view expected,
              std::string_view found);
};

/// A place in a text as messages name it: file:line:column, from 1 on.
[[nodiscard]] std::string place(std::string_view file, std::size_t line, std::size_t column);

/// Text from a file as a message may show it: in backquotes, at most 20 characters, anything unprintable as \xNN.
[[nodiscard]] std::string quoted(std::string_view text);

/// The path that a word of UTF-8 names.
[[nodiscard]] std::filesystem::path path_of(std::string_view utf8);

/// The path as messages name it, in UTF-8.
[[nodiscard]] std::string display_name(const std::filesystem::path& path);

/// Throws ReadError for a directory, a file that cannot be opened or read, and one above 1 GiB.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// The same of a text, and also throws ReadError for UTF-16, as some editors and shells of Windows write it.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

/// Writes to a temporary name in the same folder, then renames, so that nobody ever sees half a file. An existing
/// file is replaced; a link is followed; a device or pipe (/dev/null) is written to directly.
/// Throws std::runtime_error, and then nothing is left behind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace raysteps
