#pragma once

namespace raysteps {

/// Whether a person reads stderr on a terminal that understands escape sequences, rather than a file or a program. On
/// Windows the console is told to understand them.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace raysteps
