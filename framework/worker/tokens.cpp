#include "worker/tokens.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace raysteps {

std::string Words::word() {
    const std::size_t start = rest_.find_first_not_of(' ');
    if (start == std::string_view::npos) {
        throw BadCase("the case ends too early");
    }
    rest_.remove_prefix(start);
    const std::string found(rest_.substr(0, rest_.find(' ')));
    rest_.remove_prefix(found.size());
    return found;
}

// strtof and not from_chars, which some standard libraries lack for float.
float Words::number() {
    const std::string text = word();
    char* end = nullptr;
    const float value = std::strtof(text.c_str(), &end);
    if (end != text.c_str() + text.size()) {
        throw BadCase("expected a number, found " + text);
    }
    return value;
}

int Words::whole() {
    const std::string text = word();
    char* end = nullptr;
    const long value = std::strtol(text.c_str(), &end, 10);
    if (end != text.c_str() + text.size() || value < -1000000000L || value > 1000000000L) {
        throw BadCase("expected a whole number, found " + text);
    }
    return static_cast<int>(value);
}

int Words::count() {
    const int value = whole();
    if (value < 0 || value > 1000000) {
        throw BadCase("expected a count, found " + std::to_string(value));
    }
    return value;
}

glm::vec3 Words::vector() {
    const float x = number();
    const float y = number();
    const float z = number();
    return {x, y, z};
}

void Words::expect_end() {
    if (rest_.find_first_not_of(' ') != std::string_view::npos) {
        throw BadCase("the case is too long");
    }
}

Answer& Answer::word(std::string_view word) {
    text_ += ' ';
    text_ += word;
    return *this;
}

Answer& Answer::number(float value) {
    constexpr int k_enough_digits = 9;  // of any float
    char text[32];
    for (int digits = 1; digits <= k_enough_digits; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
        if (!std::isfinite(value) || std::strtof(text, nullptr) == value) {
            break;
        }
    }
    return word(text);
}

Answer& Answer::whole(long long value) { return word(std::to_string(value)); }

Answer& Answer::vector(const glm::vec3& value) { return number(value.x).number(value.y).number(value.z); }

}  // namespace raysteps
