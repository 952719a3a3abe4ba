#include "bench/json.hpp"

#include <cmath>
#include <locale>

namespace raysteps::bench {

Json::Json() {
    out_.imbue(std::locale::classic());
    out_.precision(9);
}

void Json::begin_value() {
    if (!after_key_ && has_members_.size() > 1) {
        out_ << (has_members_.back() ? ",\n" : "\n") << std::string(2 * (has_members_.size() - 1), ' ');
    }
    has_members_.back() = true;
    after_key_ = false;
}

Json& Json::open(char bracket) {
    begin_value();
    out_ << bracket;
    has_members_.push_back(false);
    return *this;
}

Json& Json::close(char bracket) {
    const bool filled = has_members_.back();
    has_members_.pop_back();
    if (filled) {
        out_ << '\n' << std::string(2 * (has_members_.size() - 1), ' ');
    }
    out_ << bracket;
    return *this;
}

void Json::write_string(std::string_view text) {
    constexpr std::string_view k_hex = "0123456789abcdef";
    out_ << '"';
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out_ << '\\' << c;
        } else if (byte < 0x20) {
            out_ << "\\u00" << k_hex[byte >> 4U] << k_hex[byte & 15U];
        } else {
            out_ << c;
        }
    }
    out_ << '"';
}

Json& Json::key(std::string_view name) {
    begin_value();
    write_string(name);
    out_ << ": ";
    after_key_ = true;
    return *this;
}

Json& Json::value(std::string_view text) {
    begin_value();
    write_string(text);
    return *this;
}

Json& Json::value(double number) {
    if (!std::isfinite(number)) {
        return null();
    }
    begin_value();
    out_ << number;
    return *this;
}

Json& Json::value(std::uint64_t number) {
    begin_value();
    out_ << number;
    return *this;
}

Json& Json::value(bool truth) {
    begin_value();
    out_ << (truth ? "true" : "false");
    return *this;
}

Json& Json::null() {
    begin_value();
    out_ << "null";
    return *this;
}

}  // namespace raysteps::bench
