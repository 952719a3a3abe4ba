#include "io/arguments.hpp"

#ifdef _WIN32
#include <cstddef>
#include <memory>

#include "io/windows_api.hpp"
#ifdef _MSC_VER
#pragma comment(lib, "shell32")  // for CommandLineToArgvW
#endif
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
#else
std::vector<std::string> utf8_arguments(int argc, char** argv) { return {argv + 1, argv + argc}; }
#endif

std::filesystem::path path_of(std::string_view utf8) { return {std::u8string(utf8.begin(), utf8.end())}; }

}  // namespace raysteps
