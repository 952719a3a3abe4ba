#include "io/read_error.hpp"

namespace raysteps {
namespace {

constexpr std::size_t k_longest_quote = 20;

std::string sentence(std::string_view where, std::string_view expected, std::string_view found) {
    std::string text(where);
    text.append(": expected ").append(expected).append(", found ").append(found);
    return text;
}

std::string place(std::string_view file, std::size_t line, std::size_t column) {
    return std::string(file) + ":" + std::to_string(line) + ":" + std::to_string(column);
}

// One character of a message: itself when it is printable ASCII, else \xNN.
std::string printable(char character) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte >= 0x20 && byte < 0x7f) {
        return {character};
    }
    constexpr std::string_view k_digits = "0123456789abcdef";
    return {'\\', 'x', k_digits[byte / 16U], k_digits[byte % 16U]};
}

}  // namespace

ReadError::ReadError(std::string_view file, std::string_view expected, std::string_view found)
    : std::runtime_error(sentence(file, expected, found)) {}

ReadError::ReadError(std::string_view file, std::size_t line, std::size_t column, std::string_view expected,
                     std::string_view found)
    : std::runtime_error(sentence(place(file, line, column), expected, found)) {}

std::string quoted(std::string_view text) {
    std::string shown;
    for (const char character : text) {
        const std::string next = printable(character);
        if (shown.size() + next.size() > k_longest_quote) {
            return "`" + shown + "...`";
        }
        shown += next;
    }
    return "`" + shown + "`";
}

}  // namespace raysteps
