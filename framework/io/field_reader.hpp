#pragma once
// Takes the fields of an entity from the scanner and says what was expected when one is missing or bad.
#include <glm/vec3.hpp>
#include <string_view>

#include "core/color.hpp"
#include "io/token_scanner.hpp"

namespace raysteps {

/// Coordinates beyond this have no place in float arithmetic: their products overflow.
inline constexpr float k_farthest = 1e9F;

/// Every function consumes its tokens and throws ReadError with `what` in the message. The names of parts
/// (`x`, `red`) come before `what`: "x of the centre".
class FieldReader {
public:
    explicit FieldReader(TokenScanner& scanner) : scanner_(scanner) {}

    /// A number that a float can hold.
    [[nodiscard]] float number(std::string_view what);

    /// As number, 0 or more.
    [[nodiscard]] float amount(std::string_view what);

    /// A length or coordinate, no farther than k_farthest from 0.
    [[nodiscard]] float coordinate(std::string_view what);

    /// Three coordinates.
    [[nodiscard]] glm::vec3 point(std::string_view what);

    /// Three amounts.
    [[nodiscard]] Color color(std::string_view what);

    /// A whole number, lowest <= number <= highest.
    [[nodiscard]] int whole(std::string_view what, int lowest, int highest);

private:
    float limited(std::string_view part, std::string_view what, float lowest, float highest);

    TokenScanner& scanner_;
};

}  // namespace raysteps
