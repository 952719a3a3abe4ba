#include "io/pbrt_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "io/files.hpp"
#include "io/numbers.hpp"

namespace raysteps {
namespace {

std::string_view unquoted(const Token& token) { return token.text.substr(1, token.text.size() - 2); }

bool is_text(const Token& token) { return token.text.starts_with('"'); }

std::string in_backquotes(std::string_view name) { return '`' + std::string(name) + '`'; }

}  // namespace

PbrtScanner::PbrtScanner(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    if (text_.starts_with(k_byte_order_mark)) {
        offset_ = k_byte_order_mark.size();
        line_start_ = offset_;
    }
}

void PbrtScanner::skip_blanks() {
    bool in_comment = false;
    for (; offset_ < text_.size(); ++offset_) {
        const char character = text_[offset_];
        if (character == '\n' || (character == '\r' && text_.substr(offset_, 2) != "\r\n")) {
            ++line_;
            line_start_ = offset_ + 1;
            in_comment = false;
        } else if (character == '#') {
            in_comment = true;
        } else if (!in_comment && !is_blank(character)) {
            return;
        }
    }
}

Token PbrtScanner::next() {
    skip_blanks();
    const std::size_t start = offset_;
    const Token at{{}, line_, start - line_start_ + 1};
    if (start == text_.size()) {
        return at;
    }
    const char first = text_[start];
    std::size_t end = start + 1;
    if (first == '"') {
        end = text_.find_first_of("\"\r\n", start + 1);
        if (end == std::string_view::npos || text_[end] != '"') {
            fail(at, "a closing quote in the same line",
                 quoted(text_.substr(start, std::min(end, text_.size()) - start)));
        }
        ++end;
    } else if (first != '[' && first != ']') {
        while (end < text_.size() && !is_blank(text_[end]) &&
               std::string_view("[]\"#").find(text_[end]) == std::string_view::npos) {
            ++end;
        }
    }
    offset_ = end;
    return {text_.substr(start, end - start), at.line, at.column};
}

Token PbrtScanner::peek() const {
    PbrtScanner ahead = *this;
    return ahead.next();
}

std::string PbrtScanner::string(std::string_view what) {
    const Token token = next();
    if (!is_text(token)) {
        fail(token, std::string(what) + " in quotes");
    }
    return std::string(unquoted(token));
}

float PbrtScanner::number(std::string_view what) {
    const Token token = next();
    const std::optional<double> number = parse_number(token.text);
    if (!number || !(std::abs(*number) <= static_cast<double>(k_farthest))) {
        fail(token, std::string(what) + ", a number within a thousand million of 0");
    }
    return static_cast<float>(*number);
}

std::vector<float> PbrtScanner::numbers(std::string_view what, std::size_t count) {
    const bool bracketed = peek().text == "[";
    if (bracketed) {
        static_cast<void>(next());
    }
    std::vector<float> found;
    while (found.size() < count) {
        found.push_back(number(what));
    }
    if (bracketed) {
        if (const Token token = next(); token.text != "]") {
            fail(token, "`]` after " + std::to_string(count) + " numbers");
        }
    }
    return found;
}

std::vector<PbrtParameter> PbrtScanner::parameters() {
    std::vector<PbrtParameter> all;
    while (is_text(peek())) {
        all.push_back(parameter());
    }
    return all;
}

PbrtParameter PbrtScanner::parameter() {
    PbrtParameter found;
    found.at = next();
    const std::vector<std::string_view> words = words_of(unquoted(found.at));
    if (words.size() != 2) {
        fail(found.at, "a type and a name in quotes, like \"float fov\"");
    }
    found.type = words[0];
    found.name = words[1];
    Token token = next();
    if (token.text != "[") {
        add_value(found, token);
        return found;
    }
    for (token = next(); token.text != "]"; token = next()) {
        if (token.is_end()) {
            fail(token, "`]` after the values of " + raysteps::quoted(found.name));
        }
        add_value(found, token);
    }
    return found;
}

void PbrtScanner::add_value(PbrtParameter& parameter, const Token& token) const {
    if (is_text(token)) {
        parameter.strings.emplace_back(unquoted(token));
        return;
    }
    if (token.text == "true" || token.text == "false") {
        parameter.strings.emplace_back(token.text);
        return;
    }
    const std::optional<double> number = parse_number(token.text);
    if (!number || !(std::abs(*number) <= static_cast<double>(k_farthest))) {
        fail(token, "a value of " + raysteps::quoted(parameter.name));
    }
    parameter.numbers.push_back(static_cast<float>(*number));
}

std::string PbrtScanner::place_of(const Token& token) const { return place(name_, token.line, token.column); }

void PbrtScanner::fail(const Token& token, std::string_view expected) const {
    fail(token, expected, token.is_end() ? "the end of the file" : quoted(token.text));
}

void PbrtScanner::fail(const Token& token, std::string_view expected, std::string_view found) const {
    throw ReadError(name_, token.line, token.column, expected, found);
}

std::filesystem::path pbrt_path(const std::filesystem::path* folder, const PbrtScanner& scanner, const Token& token,
                                const std::string& file) {
    if (folder == nullptr || file.empty()) {
        scanner.fail(token, folder == nullptr ? "a scene without other files" : "\"string filename\"",
                     file.empty() ? "none" : raysteps::quoted(file));
    }
    return *folder / path_of(file);
}

void require_near(const PbrtScanner& scanner, const Token& token, const glm::vec3& point) {
    if (!glm::all(glm::lessThanEqual(glm::abs(point), glm::vec3(k_farthest)))) {  // NaN is not, either
        scanner.fail(token, "points within a thousand million of 0", "one that is farther away");
    }
}

const PbrtParameter* PbrtParameters::find(std::string_view name) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const auto& one) { return one.name == name; });
    return found == all_.end() ? nullptr : &*found;
}

std::span<const float> PbrtParameters::numbers(const PbrtParameter& parameter, std::size_t count) const {
    if (parameter.numbers.size() != count) {
        scanner_.fail(parameter.at, std::to_string(count) + " numbers for " + in_backquotes(parameter.name),
                      std::to_string(parameter.numbers.size()));
    }
    return parameter.numbers;
}

float PbrtParameters::number(std::string_view name, float otherwise) const {
    const PbrtParameter* found = find(name);
    return found == nullptr ? otherwise : numbers(*found, 1)[0];
}

int PbrtParameters::whole(std::string_view name, int otherwise, int lowest, int highest) const {
    const PbrtParameter* found = find(name);
    if (found == nullptr) {
        return otherwise;
    }
    const float number = numbers(*found, 1)[0];
    if (number != std::floor(number) || number < static_cast<float>(lowest) || number > static_cast<float>(highest)) {
        scanner_.fail(found->at,
                      in_backquotes(name) + " from " + std::to_string(lowest) + " to " + std::to_string(highest),
                      number_text(number));
    }
    return static_cast<int>(number);
}

float PbrtParameters::share(std::string_view name, float otherwise) const {
    const float found = number(name, otherwise);
    if (!(found >= 0.0F && found <= 1.0F)) {
        scanner_.fail(directive_, in_backquotes(name) + " from 0 to 1", "another one");
    }
    return found;
}

float PbrtParameters::amount(std::string_view name, float otherwise) const {
    const float found = number(name, otherwise);
    if (!(found >= 0.0F)) {
        scanner_.fail(directive_, in_backquotes(name) + " of 0 or more", "another one");
    }
    return found;
}

std::optional<Color> PbrtParameters::color(std::string_view name) const {
    const PbrtParameter* found = find(name);
    if (found == nullptr) {
        return std::nullopt;
    }
    if (found->type != "rgb" && found->type != "color") {
        scanner_.fail(found->at, "\"rgb " + std::string(name) + "\" and three numbers");
    }
    const std::span<const float> values = numbers(*found, 3);
    if (std::any_of(values.begin(), values.end(), [](float value) { return value < 0.0F; })) {
        scanner_.fail(found->at, in_backquotes(name) + " without negative numbers", "one");
    }
    return Color(values[0], values[1], values[2]);
}

glm::vec3 PbrtParameters::point(std::string_view name, const glm::vec3& otherwise) const {
    const PbrtParameter* found = find(name);
    if (found == nullptr) {
        return otherwise;
    }
    const std::span<const float> values = numbers(*found, 3);
    return {values[0], values[1], values[2]};
}

std::string PbrtParameters::string(std::string_view name) const {
    const PbrtParameter* found = find(name);
    if (found == nullptr) {
        return {};
    }
    if (found->strings.size() != 1) {
        scanner_.fail(found->at, "one text in quotes for " + in_backquotes(name),
                      std::to_string(found->strings.size()));
    }
    return found->strings.front();
}

}  // namespace raysteps
