#pragma once
// What a program was started with: always UTF-8, though Windows has code pages.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace raysteps {

/// The words after the program's name. On Windows they come from the system and not from argv, where a letter that the
/// code page lacks has become a question mark; and what the program prints on the console is taken for UTF-8 from now on.
[[nodiscard]] std::vector<std::string> utf8_arguments(int argc, char** argv);

/// The path that such a word names.
[[nodiscard]] std::filesystem::path path_of(std::string_view utf8);

}  // namespace raysteps
