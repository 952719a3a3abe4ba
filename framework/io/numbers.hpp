#pragma once
// Numbers to and from text, the same in every locale.
#include <optional>
#include <string>
#include <string_view>

namespace raysteps {

/// Of the ten, whatever the locale.
[[nodiscard]] inline bool is_digit(char character) { return character >= '0' && character <= '9'; }

/// A decimal number such as `1`, `-2.5`, `+1`, `.5`, `5.` or `1e-3`, of at most 100 characters. Nothing for any
/// other text, `nan`, `inf` and hexadecimal included. Infinity when it is too large for a double.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// A whole number from 0 to 999999999 in digits only. Nothing for any other text.
[[nodiscard]] std::optional<int> parse_whole(std::string_view text);

/// Whether a token is meant to be a number: it starts with a digit, a sign or a point.
[[nodiscard]] bool looks_like_number(std::string_view text);

/// The shortest text that reads back as the same float; `inf`, `-inf` or `nan`, too.
[[nodiscard]] std::string number_text(float number);

/// At most so many digits, as printf's %g has them.
[[nodiscard]] std::string number_text(double number, int digits);

}  // namespace raysteps
