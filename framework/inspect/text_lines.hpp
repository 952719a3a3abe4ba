#pragma once
// Lines with an indentation, and the words for numbers in them.
#include <cstdint>
#include <string>

#include "core/color.hpp"
#include "inspect/pixel_record.hpp"

namespace raysteps {

class TextLines {
public:
    /// A line at this level; far down the indentation grows no more.
    void line(int level, const std::string& text);
    /// A line that begins with a word in a column of its own.
    void line(int level, const std::string& label, const std::string& text);

    [[nodiscard]] const std::string& result() const { return text_; }

private:
    std::string text_;
};

[[nodiscard]] std::string brief(float value);  ///< six digits
[[nodiscard]] std::string brief(const glm::vec3& value);
[[nodiscard]] std::string share(std::uint64_t part, std::uint64_t whole);        ///< such as 0.16 %
[[nodiscard]] std::string amount(std::uint64_t count, const std::string& noun);  ///< 1 box, 2 boxes
[[nodiscard]] std::string search_words(const SearchCounts& counts, std::uint64_t surfaces);

}  // namespace raysteps
