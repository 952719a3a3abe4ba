#include "io/numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <locale>
#include <sstream>
#include <system_error>
#include <version>

namespace raysteps {
namespace {

constexpr std::size_t k_longest_number = 100;
constexpr std::size_t k_longest_whole = 9;

std::size_t skip_digits(std::string_view text, std::size_t from) {
    while (from < text.size() && is_digit(text[from])) {
        ++from;
    }
    return from;
}

std::size_t skip_sign(std::string_view text, std::size_t from) {
    return from < text.size() && (text[from] == '+' || text[from] == '-') ? from + 1 : from;
}

/// A number's text taken apart: digits * 10^power, without the sign.
struct Decimal {
    std::uint64_t digits = 0;  ///< wraps round where there are too many of them
    std::size_t count = 0;     ///< of all digits, also of zeros in front
    int power = 0;
};

/// Takes the digits from there, and says where they end.
std::size_t take_digits(std::string_view text, std::size_t from, Decimal& decimal) {
    std::size_t at = from;
    for (; at < text.size() && is_digit(text[at]); ++at) {
        decimal.digits = 10 * decimal.digits + static_cast<std::uint64_t>(text[at] - '0');
    }
    decimal.count += at - from;
    return at;
}

/// `e` and a whole number that ends the text; nothing for any other text. At most 99999, or as much below 0.
std::optional<int> parse_exponent(std::string_view text) {
    const std::size_t first = skip_sign(text, 1);
    if ((text[0] != 'e' && text[0] != 'E') || first == text.size() || skip_digits(text, first) != text.size()) {
        return std::nullopt;
    }
    constexpr int k_largest = 99'999;
    int power = 0;
    for (const char digit : text.substr(first)) {
        power = std::min(10 * power + (digit - '0'), k_largest);
    }
    return text[1] == '-' ? -power : power;
}

/// Nothing when the text is no number.
std::optional<Decimal> take_apart(std::string_view text) {
    Decimal decimal;
    std::size_t at = take_digits(text, skip_sign(text, 0), decimal);
    if (at < text.size() && text[at] == '.') {
        const std::size_t end = take_digits(text, at + 1, decimal);
        decimal.power = -static_cast<int>(end - at - 1);
        at = end;
    }
    if (decimal.count == 0) {
        return std::nullopt;
    }
    if (at < text.size()) {
        const std::optional<int> exponent = parse_exponent(text.substr(at));
        if (!exponent) {
            return std::nullopt;
        }
        decimal.power += *exponent;
    }
    return decimal;
}

// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> k_tens{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                        1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The number without its sign, where one product or quotient of two exact doubles gives it: nearly always (Clinger
/// 1990). It is rounded once, so it is the nearest double.
std::optional<double> plain_value(const Decimal& decimal) {
    constexpr std::size_t k_max_digits = 19;  // so many fit into 64 bits
    constexpr std::uint64_t k_largest = std::uint64_t{1} << 53U;
    const auto power = static_cast<std::size_t>(std::abs(decimal.power));
    if (decimal.count > k_max_digits || decimal.digits > k_largest || power >= k_tens.size()) {
        return std::nullopt;
    }
    const auto digits = static_cast<double>(decimal.digits);
    return decimal.power < 0 ? digits / k_tens[power] : digits * k_tens[power];
}

// At most 100 characters: only the exponent can lead out of a double's range, and its sign says to which side.
double out_of_range(const Decimal& decimal) {
    return decimal.power < 0 ? 0.0 : std::numeric_limits<double>::infinity();
}

/// The nearest double to a number without a sign, whatever its digits.
double exact_value(std::string_view text, const Decimal& decimal) {
    double number = 0.0;
#ifdef __cpp_lib_to_chars
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    return result.ec == std::errc::result_out_of_range ? out_of_range(decimal) : number;
#else
    std::istringstream stream{std::string(text)};
    stream.imbue(std::locale::classic());
    stream >> number;
    return stream.fail() ? out_of_range(decimal) : number;
#endif
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    const std::optional<Decimal> decimal = text.size() > k_longest_number ? std::nullopt : take_apart(text);
    if (!decimal) {
        return std::nullopt;
    }
    const std::optional<double> plain = plain_value(*decimal);
    const double size = plain ? *plain : exact_value(text.substr(skip_sign(text, 0)), *decimal);
    return text.front() == '-' ? -size : size;
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
#ifdef __cpp_lib_to_chars
    std::array<char, 64> buffer{};
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number);
    return {buffer.data(), result.ptr};
#else
    std::string text;
    for (int digits = 1; digits <= std::numeric_limits<float>::max_digits10; ++digits) {
        text = number_text(static_cast<double>(number), digits);
        if (static_cast<float>(parse_number(text).value_or(0.0)) == number) {
            break;
        }
    }
    return text;
#endif
}

std::string number_text(double number, int digits) {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(digits);
    stream << number;
    return stream.str();
}

}  // namespace raysteps
