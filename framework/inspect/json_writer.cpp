#include "inspect/json_writer.hpp"

#include <array>
#include <cmath>

#include "io/numbers.hpp"

namespace raysteps {

void JsonWriter::separate() {
    if (needs_comma_) {
        text_ += ", ";
    }
    needs_comma_ = true;
}

JsonWriter& JsonWriter::raw(std::string_view value) {
    separate();
    text_ += value;
    return *this;
}

JsonWriter& JsonWriter::begin_object() {
    raw("{");
    needs_comma_ = false;
    return *this;
}

JsonWriter& JsonWriter::end_object() {
    text_ += '}';
    needs_comma_ = true;
    return *this;
}

JsonWriter& JsonWriter::begin_array() {
    raw("[");
    needs_comma_ = false;
    return *this;
}

JsonWriter& JsonWriter::end_array() {
    text_ += ']';
    needs_comma_ = true;
    return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
    text(name);
    text_ += ": ";
    needs_comma_ = false;
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

JsonWriter& JsonWriter::whole(std::uint64_t value) { return raw(std::to_string(value)); }
JsonWriter& JsonWriter::flag(bool value) { return raw(value ? "true" : "false"); }
JsonWriter& JsonWriter::null() { return raw("null"); }

JsonWriter& JsonWriter::vector(const glm::vec3& value) {
    return begin_array().number(value.x).number(value.y).number(value.z).end_array();
}

JsonWriter& JsonWriter::line_break() {
    if (needs_comma_) {
        text_ += ",";
        needs_comma_ = false;
    }
    text_ += "\n";
    return *this;
}

}  // namespace raysteps
