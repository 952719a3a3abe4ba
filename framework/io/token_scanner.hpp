#pragma once
// Splits text into tokens: what stands between white space. `#` starts a comment that ends with the line.
#include <cstddef>
#include <string>
#include <string_view>

namespace raysteps {

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

}  // namespace raysteps
