#include "io/field_reader.hpp"

#include <limits>
#include <optional>
#include <string>

#include "io/numbers.hpp"

namespace raysteps {
namespace {

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

}  // namespace

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
    return static_cast<float>(*number);
}

}  // namespace raysteps
