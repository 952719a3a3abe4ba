#include "inspect/text_lines.hpp"

#include <algorithm>
#include <cmath>

#include "io/numbers.hpp"

namespace raysteps {
namespace {

constexpr int k_deepest = 16;
constexpr std::size_t k_label = 12;

}  // namespace

void TextLines::line(int level, const std::string& text) {
    text_ += std::string(2 * static_cast<std::size_t>(std::min(level, k_deepest)), ' ') + text + "\n";
}

void TextLines::line(int level, const std::string& label, const std::string& text) {
    line(level, label + std::string(label.size() < k_label ? k_label - label.size() : 1, ' ') + text);
}

std::string brief(float value) {
    const double tidy = std::abs(value) < 1e-7F ? 0.0 : static_cast<double>(value);  // no -0 and no rounding noise
    return number_text(std::isnan(value) ? static_cast<double>(value) : tidy, 6);
}

std::string brief(const glm::vec3& value) {
    return "(" + brief(value.x) + ", " + brief(value.y) + ", " + brief(value.z) + ")";
}

std::string share(std::uint64_t part, std::uint64_t whole) {
    return number_text(whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole), 3) + " %";
}

std::string amount(std::uint64_t count, const std::string& noun) {
    const std::string ending = noun.ends_with('x') || noun.ends_with('s') ? "es" : "s";
    return std::to_string(count) + " " + noun + (count == 1 ? "" : ending);
}

std::string search_words(const SearchCounts& counts, std::uint64_t surfaces) {
    std::string text;
    if (counts.box_tests > 0) {
        text = amount(counts.box_tests, "box") + " asked, " + std::to_string(counts.boxes_entered) + " entered; ";
    }
    text += amount(counts.surface_tests, "surface test");
    if (counts.unique_surfaces != counts.surface_tests) {
        text += " on " + amount(counts.unique_surfaces, "different surface");
    }
    return text + " (" + share(counts.unique_surfaces, surfaces) + " of " + std::to_string(surfaces) + ")";
}

}  // namespace raysteps
