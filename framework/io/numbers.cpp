#include "io/numbers.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <limits>
#include <locale>
#include <sstream>
#include <system_error>
#include <version>

namespace raysteps {
namespace {

constexpr std::size_t k_longest_number = 100;
constexpr std::size_t k_longest_whole = 9;

bool is_digit(char character) { return character >= '0' && character <= '9'; }

std::size_t skip_digits(std::string_view text, std::size_t from) {
    while (from < text.size() && is_digit(text[from])) {
        ++from;
    }
    return from;
}

std::size_t skip_sign(std::string_view text, std::size_t from) {
    return from < text.size() && (text[from] == '+' || text[from] == '-') ? from + 1 : from;
}

// Where the exponent starts, the end of the text when there is none; nothing when the text is no number.
std::optional<std::size_t> exponent_start(std::string_view text) {
    const std::size_t whole = skip_sign(text, 0);
    const std::size_t point = skip_digits(text, whole);
    const bool has_point = point < text.size() && text[point] == '.';
    const std::size_t end = has_point ? skip_digits(text, point + 1) : point;
    const std::size_t digits = (end - whole) - (has_point ? 1U : 0U);
    if (digits == 0) {
        return std::nullopt;
    }
    if (end == text.size()) {
        return end;
    }
    const std::size_t power = skip_sign(text, end + 1);
    const bool is_exponent = (text[end] == 'e' || text[end] == 'E') && power < text.size();
    return is_exponent && skip_digits(text, power) == text.size() ? std::optional(end) : std::nullopt;
}

// At most 100 characters: only the exponent can lead out of a double's range, and its sign says to which side.
double out_of_range(std::string_view text, std::size_t exponent) {
    const bool tiny = exponent + 1 < text.size() && text[exponent + 1] == '-';
    const double size = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return text.front() == '-' ? -size : size;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    const std::optional<std::size_t> exponent = text.size() > k_longest_number ? std::nullopt : exponent_start(text);
    if (!exponent) {
        return std::nullopt;
    }
    double number = 0.0;
#if defined(__cpp_lib_to_chars)
    const std::string_view no_plus = text.front() == '+' ? text.substr(1) : text;
    const auto result = std::from_chars(no_plus.data(), no_plus.data() + no_plus.size(), number);
    return result.ec == std::errc::result_out_of_range ? out_of_range(text, *exponent) : number;
#else
    std::istringstream stream{std::string(text)};
    stream.imbue(std::locale::classic());
    stream >> number;
    return stream.fail() ? out_of_range(text, *exponent) : number;
#endif
}

std::optional<int> parse_whole(std::string_view text) {
    if (text.empty() || text.size() > k_longest_whole || skip_digits(text, 0) != text.size()) {
        return std::nullopt;
    }
    int number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

bool looks_like_number(std::string_view text) {
    return !text.empty() && (is_digit(text[0]) || text[0] == '+' || text[0] == '-' || text[0] == '.');
}

std::string number_text(float number) {
#if defined(__cpp_lib_to_chars)
    std::array<char, 64> buffer{};
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number);
    return {buffer.data(), result.ptr};
#else
    std::string text;
    for (int digits = 1; digits <= std::numeric_limits<float>::max_digits10; ++digits) {
        std::ostringstream stream;
        stream.imbue(std::locale::classic());
        stream.precision(digits);
        stream << number;
        text = stream.str();
        if (static_cast<float>(parse_number(text).value_or(0.0)) == number) {
            break;
        }
    }
    return text;
#endif
}

}  // namespace raysteps
