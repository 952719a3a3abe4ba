#include "io/json_writer.hpp"

#include <cmath>
#include <utility>

#include "io/numbers.hpp"

namespace raysteps {

void JsonWriter::indent() { text_ += "\n" + std::string(2 * (levels_.size() - 1), ' '); }

void JsonWriter::separate() {
    if (after_key_) {
        after_key_ = false;
        return;
    }
    Level& level = levels_.back();
    const bool block = level.layout == Layout::block;
    if (level.needs_comma) {
        text_ += block ? "," : ", ";
    }
    if (block) {
        indent();
    }
    level.needs_comma = true;
}

JsonWriter& JsonWriter::open(char bracket, Layout layout) {
    separate();
    text_ += bracket;
    levels_.push_back({.layout = layout});
    return *this;
}

JsonWriter& JsonWriter::close(char bracket) {
    const Level closed = levels_.back();
    levels_.pop_back();
    if (closed.layout == Layout::block && closed.needs_comma) {
        indent();
    }
    text_ += bracket;
    return *this;
}

JsonWriter& JsonWriter::raw(std::string_view value) {
    separate();
    text_ += value;
    return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
    text(name);
    text_ += ": ";
    after_key_ = true;
    return *this;
}

JsonWriter& JsonWriter::text(std::string_view value) {
    constexpr std::string_view k_digits = "0123456789abcdef";
    separate();
    text_ += '"';
    for (const char letter : value) {
        const auto code = static_cast<unsigned char>(letter);
        if (letter == '"' || letter == '\\') {
            text_ += '\\';
            text_ += letter;
        } else if (code < 0x20U) {
            text_ += "\\u00";
            text_ += k_digits[code >> 4U];
            text_ += k_digits[code & 15U];
        } else {
            text_ += letter;
        }
    }
    text_ += '"';
    return *this;
}

JsonWriter& JsonWriter::number(float value) {
    if (std::isnan(value)) {
        return text("nan");
    }
    if (std::isinf(value)) {
        return text(value > 0.0F ? "inf" : "-inf");
    }
    return raw(number_text(value));
}

JsonWriter& JsonWriter::number(double value) { return std::isfinite(value) ? raw(number_text(value, 9)) : null(); }
JsonWriter& JsonWriter::whole(std::uint64_t value) { return raw(std::to_string(value)); }
JsonWriter& JsonWriter::flag(bool value) { return raw(value ? "true" : "false"); }
JsonWriter& JsonWriter::null() { return raw("null"); }

JsonWriter& JsonWriter::vector(const glm::vec3& value) {
    return begin_array().number(value.x).number(value.y).number(value.z).end_array();
}

JsonWriter& JsonWriter::line_break() {
    if (!after_key_) {
        text_ += std::exchange(levels_.back().needs_comma, false) ? "," : "";
    }
    text_ += '\n';
    return *this;
}

}  // namespace raysteps
