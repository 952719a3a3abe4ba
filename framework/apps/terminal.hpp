#pragma once
#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace raysteps {

/// Whether a person reads stderr, rather than a file or a program.
inline bool stderr_is_terminal() {
#ifdef _WIN32
    return _isatty(2) != 0;
#else
    return isatty(2) != 0;
#endif
}

}  // namespace raysteps
