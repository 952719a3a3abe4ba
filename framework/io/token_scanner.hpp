#pragma once
// Splits text into tokens: what stands between white space. `#` starts a comment that ends with the line. And takes the
// fields of an entity from them.
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/color.hpp"

namespace raysteps {

/// Of UTF-8: some editors put it before a text.
inline constexpr std::string_view k_byte_order_mark = "\xef\xbb\xbf";

/// A piece of the text and where it starts. An empty token is the end of the text.
struct Token {
    std::string_view text;
    std::size_t line = 1;
    std::size_t column = 1;

    [[nodiscard]] bool is_end() const { return text.empty(); }
};

/// LF, CRLF and a lone CR end a line. A UTF-8 byte order mark at the start is skipped.
class TokenScanner {
public:
    /// The text must outlive the scanner and its tokens.
    TokenScanner(std::string_view text, std::string name);

    Token next();                ///< the next token, which is consumed
    [[nodiscard]] Token peek();  ///< the next token, which stays

    /// Bytes consumed so far: the end of the last token that next() gave.
    [[nodiscard]] std::size_t offset() const { return offset_; }

    /// The place right after the last token, as an empty token.
    [[nodiscard]] Token here() const { return {{}, line_, column()}; }

    /// Throws ReadError at the token.
    [[noreturn]] void fail(const Token& token, std::string_view expected) const;
    [[noreturn]] void fail(const Token& token, std::string_view expected, std::string_view found) const;

    /// At a number that is wrong as a float, which may be another one than the token's: that is said, too.
    [[noreturn]] void fail_as_float(const Token& token, std::string_view expected) const;

private:
    void skip_blanks();
    void end_line();
    [[nodiscard]] std::size_t column() const { return offset_ - line_start_ + 1; }

    std::string_view text_;
    std::string name_;
    std::size_t offset_ = 0;
    std::size_t line_ = 1;
    std::size_t line_start_ = 0;  ///< where column 1 of the line is
};

/// Space, tab, CR, LF, vertical tab or form feed, whatever the locale.
[[nodiscard]] bool is_blank(char character);

/// What stands between blanks, without a look at comments.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

/// Coordinates beyond this have no place in float arithmetic: their products overflow.
inline constexpr float k_farthest = 1e9F;

/// Every function consumes its tokens and throws ReadError with `what` in the message. The names of parts
/// (`x`, `red`) come before `what`: "x of the centre".
class FieldReader {
public:
    explicit FieldReader(TokenScanner& scanner) : scanner_(scanner) {}

    /// A number that a float can hold.
    [[nodiscard]] float number(std::string_view what);

    /// As number, 0 or more.
    [[nodiscard]] float amount(std::string_view what);

    /// A length or coordinate, no farther than k_farthest from 0.
    [[nodiscard]] float coordinate(std::string_view what);

    /// Three coordinates.
    [[nodiscard]] glm::vec3 point(std::string_view what);

    /// Three amounts.
    [[nodiscard]] Color color(std::string_view what);

    /// A whole number, lowest <= number <= highest.
    [[nodiscard]] int whole(std::string_view what, int lowest, int highest);

    /// Whether a number that was read is not 0, but as a float it is.
    [[nodiscard]] bool has_vanished() const { return has_vanished_; }

private:
    float limited(std::string_view part, std::string_view what, float lowest, float highest);

    TokenScanner& scanner_;
    bool has_vanished_ = false;
};

}  // namespace raysteps
