#pragma once
// Splits a scene in pbrt's format into directives and parameters.
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/color.hpp"
#include "io/token_scanner.hpp"

namespace raysteps {

/// `"type name"` and its values.
struct PbrtParameter {
    Token at;
    std::string type;
    std::string name;
    std::vector<float> numbers;
    std::vector<std::string> strings;
};

/// Tokens are words, numbers, texts in double quotes (with them), `[` and `]`. `#` starts a comment that ends with the
/// line; lines end, and a byte order mark is skipped, as in NFF.
class PbrtScanner {
public:
    /// The text must outlive the scanner and its tokens.
    PbrtScanner(std::string_view text, std::string name);

    Token next();
    [[nodiscard]] Token peek() const;

    /// What stands between quotes. All three throw ReadError for anything else.
    std::string string(std::string_view what);
    float number(std::string_view what);
    /// So many, in brackets or not.
    std::vector<float> numbers(std::string_view what, std::size_t count);

    /// All that follow, in any order.
    std::vector<PbrtParameter> parameters();

    /// As messages begin: file:line:column.
    [[nodiscard]] std::string place_of(const Token& token) const;

    [[noreturn]] void fail(const Token& token, std::string_view expected) const;
    [[noreturn]] void fail(const Token& token, std::string_view expected, std::string_view found) const;

private:
    PbrtParameter parameter();
    void add_value(PbrtParameter& parameter, const Token& token) const;
    void skip_blanks();

    std::string_view text_;
    std::string name_;
    std::size_t offset_ = 0;
    std::size_t line_ = 1;
    std::size_t line_start_ = 0;
};

/// Where a file lies that a scene names. Throws ReadError where the scene has no folder, or names none.
[[nodiscard]] std::filesystem::path pbrt_path(const std::filesystem::path* folder, const PbrtScanner& scanner,
                                              const Token& token, const std::string& file);

/// Throws ReadError for a point that lies farther than k_farthest from 0, or nowhere.
void require_near(const PbrtScanner& scanner, const Token& token, const glm::vec3& point);

/// The parameters of one directive.
class PbrtParameters {
public:
    PbrtParameters(const PbrtScanner& scanner, const Token& directive, std::vector<PbrtParameter> all)
        : scanner_(scanner), directive_(directive), all_(std::move(all)) {}

    [[nodiscard]] const PbrtParameter* find(std::string_view name) const;
    [[nodiscard]] const Token& directive() const { return directive_; }

    [[nodiscard]] float number(std::string_view name, float otherwise) const;
    [[nodiscard]] float share(std::string_view name, float otherwise) const;   ///< from 0 to 1
    [[nodiscard]] float amount(std::string_view name, float otherwise) const;  ///< 0 or more
    [[nodiscard]] int whole(std::string_view name, int otherwise, int lowest, int highest) const;
    [[nodiscard]] std::optional<Color> color(std::string_view name) const;  ///< 0 or more
    [[nodiscard]] glm::vec3 point(std::string_view name, const glm::vec3& otherwise) const;
    [[nodiscard]] std::string string(std::string_view name) const;  ///< empty where there is none

private:
    [[nodiscard]] std::span<const float> numbers(const PbrtParameter& parameter, std::size_t count) const;

    const PbrtScanner& scanner_;
    Token directive_;
    std::vector<PbrtParameter> all_;
};

}  // namespace raysteps
