#include "io/token_scanner.hpp"

#include <algorithm>
#include <utility>

#include "io/read_error.hpp"

namespace raysteps {
namespace {

constexpr std::string_view k_byte_order_mark = "\xef\xbb\xbf";

bool ends_line(char character) { return character == '\n' || character == '\r'; }

// Nearly all characters of a scene are above the space, and take one comparison.
bool ends_token(char character) {
    const bool is_ordinary = static_cast<unsigned char>(character) > '#';
    return !is_ordinary && (character == '#' || is_blank(character));
}

}  // namespace

bool is_blank(char character) {
    return character == ' ' || character == '\t' || character == '\v' || character == '\f' || ends_line(character);
}

TokenScanner::TokenScanner(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    if (text_.starts_with(k_byte_order_mark)) {
        offset_ = k_byte_order_mark.size();
        line_start_ = offset_;
    }
}

Token TokenScanner::next() {
    skip_blanks();
    Token token = here();
    const std::size_t start = offset_;
    while (offset_ < text_.size() && !ends_token(text_[offset_])) {
        ++offset_;
    }
    token.text = text_.substr(start, offset_ - start);
    return token;
}

Token TokenScanner::peek() {
    const std::size_t offset = offset_;
    const std::size_t line = line_;
    const std::size_t line_start = line_start_;
    const Token token = next();
    offset_ = offset;
    line_ = line;
    line_start_ = line_start;
    return token;
}

void TokenScanner::fail(const Token& token, std::string_view expected) const {
    fail(token, expected, token.is_end() ? "the end of the file" : quoted(token.text));
}

void TokenScanner::fail(const Token& token, std::string_view expected, std::string_view found) const {
    throw ReadError(name_, token.line, token.column, expected, found);
}

void TokenScanner::skip_blanks() {
    while (offset_ < text_.size() && ends_token(text_[offset_])) {
        if (text_[offset_] == '#') {
            offset_ = std::min(text_.find_first_of("\r\n", offset_), text_.size());
        } else if (ends_line(text_[offset_])) {
            end_line();
        } else {
            ++offset_;
        }
    }
}

// In CRLF only the LF starts a new line.
void TokenScanner::end_line() {
    const bool is_cr = text_[offset_] == '\r';
    ++offset_;
    if (is_cr && offset_ < text_.size() && text_[offset_] == '\n') {
        return;
    }
    ++line_;
    line_start_ = offset_;
}

}  // namespace raysteps
