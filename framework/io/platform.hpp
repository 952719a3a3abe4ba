#pragma once
// What programs ask of the system they run on, where Windows is unlike the others.
#include <string>
#include <vector>

namespace raysteps {

/// The words after the program's name. On Windows they come from the system and not from argv, where a letter that the
/// code page lacks has become a question mark; and what the program prints on the console is taken for UTF-8 from now
/// on.
[[nodiscard]] std::vector<std::string> utf8_arguments(int argc, char** argv);

/// Whether a person reads stderr on a terminal that understands escape sequences, rather than a file or a program. On
/// Windows the console is told to understand them.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace raysteps
