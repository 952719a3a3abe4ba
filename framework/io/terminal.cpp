#include "io/terminal.hpp"

#ifdef _WIN32
#include "io/windows_api.hpp"
#else
#include <unistd.h>
#endif

namespace raysteps {

#ifdef _WIN32
bool stderr_is_terminal() {
    const HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    return GetConsoleMode(console, &mode) != 0 &&
           SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}
#else
bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }
#endif

}  // namespace raysteps
