#pragma once
// What a reader throws when a file is not what it should be.
#include <cstddef>
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

/// Text from a file as a message may show it: in backquotes, at most 20 characters, anything unprintable as \xNN.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace raysteps
