#include "io/token_scanner.hpp"

#include <utility>

#include "io/read_error.hpp"

namespace raysteps {
namespace {

constexpr std::string_view k_byte_order_mark = "\xef\xbb\xbf";

bool ends_line(char character) { return character == '\n' || character == '\r'; }

}  // namespace

bool is_blank(char character) {
    return character == ' ' || character == '\t' || character == '\v' || character == '\f' || ends_line(character);
}

TokenScanner::TokenScanner(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    if (text_.starts_with(k_byte_order_mark)) {
        offset_ = k_byte_order_mark.size();
    }
}

Token TokenScanner::next() {
    skip_blanks();
    Token token{{}, line_, column_};
    const std::size_t start = offset_;
    while (offset_ < text_.size() && !is_blank(text_[offset_]) && text_[offset_] != '#') {
        step();
    }
    token.text = text_.substr(start, offset_ - start);
    return token;
}

Token TokenScanner::peek() {
    const std::size_t offset = offset_;
    const std::size_t line = line_;
    const std::size_t column = column_;
    const Token token = next();
    offset_ = offset;
    line_ = line;
    column_ = column;
    return token;
}

void TokenScanner::fail(const Token& token, std::string_view expected) const {
    fail(token, expected, token.is_end() ? "the end of the file" : quoted(token.text));
}

void TokenScanner::fail(const Token& token, std::string_view expected, std::string_view found) const {
    throw ReadError(name_, token.line, token.column, expected, found);
}

void TokenScanner::skip_blanks() {
    bool in_comment = false;
    while (offset_ < text_.size()) {
        const char character = text_[offset_];
        if (ends_line(character)) {
            in_comment = false;
        } else if (character == '#') {
            in_comment = true;
        } else if (!in_comment && !is_blank(character)) {
            return;
        }
        step();
    }
}

// In CRLF only the LF starts a new line.
void TokenScanner::step() {
    const char character = text_[offset_];
    ++offset_;
    const bool before_lf = offset_ < text_.size() && text_[offset_] == '\n';
    if (character == '\n' || (character == '\r' && !before_lf)) {
        ++line_;
        column_ = 1;
    } else {
        ++column_;
    }
}

}  // namespace raysteps
