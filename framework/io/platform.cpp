#include "io/platform.hpp"

#ifdef _WIN32
#include <cstddef>
#include <memory>

#ifndef NOMINMAX
#define NOMINMAX
#endif
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#include <windows.h>
// The line above must come first.
#include <shellapi.h>
#ifndef ENABLE_VIRTUAL_TERMINAL_PROCESSING
#define ENABLE_VIRTUAL_TERMINAL_PROCESSING 0x0004
#endif
#ifdef _MSC_VER
#pragma comment(lib, "shell32")  // for CommandLineToArgvW
#endif
#else
#include <unistd.h>
#endif

namespace raysteps {

#ifdef _WIN32
namespace {

std::string utf8(const wchar_t* word) {
    const int size = WideCharToMultiByte(CP_UTF8, 0, word, -1, nullptr, 0, nullptr, nullptr);
    std::string text(static_cast<std::size_t>(size), '\0');
    WideCharToMultiByte(CP_UTF8, 0, word, -1, text.data(), size, nullptr, nullptr);
    text.resize(text.size() - 1);  // the zero at the end
    return text;
}

}  // namespace

std::vector<std::string> utf8_arguments(int /*argc*/, char** /*argv*/) {
    SetConsoleOutputCP(CP_UTF8);
    int count = 0;
    const std::unique_ptr<LPWSTR, decltype(&LocalFree)> words(CommandLineToArgvW(GetCommandLineW(), &count), LocalFree);
    std::vector<std::string> arguments;
    for (int i = 1; i < count; ++i) {
        arguments.push_back(utf8(words.get()[i]));
    }
    return arguments;
}

bool stderr_is_terminal() {
    const HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    return GetConsoleMode(console, &mode) != 0 &&
           SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}
#else
std::vector<std::string> utf8_arguments(int argc, char** argv) { return {argv + 1, argv + argc}; }

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }
#endif

}  // namespace raysteps
