#include "io/token_scanner.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <utility>

#include "io/files.hpp"
#include "io/numbers.hpp"

namespace raysteps {
namespace {

bool ends_line(char character) { return character == '\n' || character == '\r'; }

// Nearly all characters of a scene are above the space, and take one comparison.
bool ends_token(char character) {
    const bool is_ordinary = static_cast<unsigned char>(character) > '#';
    return !is_ordinary && (character == '#' || is_blank(character));
}

constexpr float k_largest = std::numeric_limits<float>::max();

std::string range_text(float lowest, float highest) {
    if (lowest == 0.0F) {
        return highest == k_largest ? "a number of at least 0" : "a number from 0 to " + number_text(highest);
    }
    return "a number from " + number_text(lowest) + " to " + number_text(highest);
}

std::string full_name(std::string_view part, std::string_view what) {
    return part.empty() ? std::string(what) : std::string(part) + " of " + std::string(what);
}

// Whether it is made of signs in UTF-8, as opposed to the bytes of a picture.
bool is_utf8_text(std::string_view token) {
    int to_come = 0;  // bytes of the sign that was begun
    for (const char character : token) {
        const auto byte = static_cast<unsigned char>(character);
        const int ones = std::countl_one(byte);  // none for ASCII, one where a sign goes on, else how many bytes it has
        if (byte < ' ' || byte == 0x7f || ones > 4 || (ones == 1) != (to_come > 0)) {
            return false;
        }
        to_come = std::max(ones == 1 ? to_come : ones, 1) - 1;
    }
    return to_come == 0;
}

// Of words: a corner of a mesh may be `//2`.
bool begins_a_comment(std::string_view token) {
    return token == "//" || (token.starts_with("//") && (token[2] | ' ') >= 'a' && (token[2] | ' ') <= 'z');
}

// The mistake that is likely behind a token.
std::string_view why_not(std::string_view token) {
    if (!is_utf8_text(token)) {
        return "";
    }
    if (begins_a_comment(token)) {
        return ": comments begin with #";
    }
    if (std::any_of(token.begin(), token.end(), [](char one) { return static_cast<unsigned char>(one) > 0x7f; })) {
        return ", with a sign that is not ASCII: type it anew";
    }
    return token.find(',') != std::string_view::npos ? ": numbers have a point, and blanks between them" : "";
}

}  // namespace

bool is_blank(char character) {
    return character == ' ' || character == '\t' || character == '\v' || character == '\f' || ends_line(character);
}

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    for (auto at = text.begin(); at != text.end();) {
        const auto begin = std::find_if_not(at, text.end(), is_blank);
        at = std::find_if(begin, text.end(), is_blank);
        if (begin != at) {
            words.push_back(
                text.substr(static_cast<std::size_t>(begin - text.begin()), static_cast<std::size_t>(at - begin)));
        }
    }
    return words;
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
    fail(token, expected,
         token.is_end() ? "the end of the file" : quoted(token.text) + std::string(why_not(token.text)));
}

void TokenScanner::fail(const Token& token, std::string_view expected, std::string_view found) const {
    throw ReadError(name_, token.line, token.column, expected, found);
}

void TokenScanner::fail_as_float(const Token& token, std::string_view expected) const {
    const std::optional<double> typed = parse_number(token.text);
    const std::string as_float = number_text(static_cast<float>(typed.value_or(0.0)));
    const bool is_another = typed && parse_number(as_float) != typed;
    fail(token, expected, quoted(token.text) + (is_another ? ", which as a float is " + as_float : ""));
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

float FieldReader::number(std::string_view what) { return limited("", what, -k_largest, k_largest); }

float FieldReader::amount(std::string_view what) { return limited("", what, 0.0F, k_largest); }

float FieldReader::coordinate(std::string_view what) { return limited("", what, -k_farthest, k_farthest); }

// One statement each: the order of evaluation of arguments is free, that of the fields is not.
glm::vec3 FieldReader::point(std::string_view what) {
    const float x = limited("x", what, -k_farthest, k_farthest);
    const float y = limited("y", what, -k_farthest, k_farthest);
    const float z = limited("z", what, -k_farthest, k_farthest);
    return {x, y, z};
}

Color FieldReader::color(std::string_view what) {
    const float red = limited("red", what, 0.0F, k_largest);
    const float green = limited("green", what, 0.0F, k_largest);
    const float blue = limited("blue", what, 0.0F, k_largest);
    return {red, green, blue};
}

int FieldReader::whole(std::string_view what, int lowest, int highest) {
    const Token token = scanner_.next();
    const std::optional<int> number = parse_whole(token.text);
    if (!number || *number < lowest || *number > highest) {
        scanner_.fail(token, std::string(what) + ", a whole number from " + std::to_string(lowest) + " to " +
                                 std::to_string(highest));
    }
    return *number;
}

float FieldReader::limited(std::string_view part, std::string_view what, float lowest, float highest) {
    const Token token = scanner_.next();
    const std::optional<double> number = parse_number(token.text);
    if (!number) {
        scanner_.fail(token, full_name(part, what) + ", a number");
    }
    if (!(*number >= lowest && *number <= highest)) {
        scanner_.fail(token, full_name(part, what) + ", " + range_text(lowest, highest));
    }
    const auto value = static_cast<float>(*number);
    has_vanished_ = has_vanished_ || (value == 0.0F && *number != 0.0);
    return value;
}

}  // namespace raysteps
