#pragma once
// JSON, piece by piece.
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace raysteps {

/// Writes values one after the other; commas come by themselves.
class JsonWriter {
public:
    /// How members stand: side by side, or each on a line of its own.
    enum class Layout { line, block };

    JsonWriter& begin_object(Layout layout = Layout::line) { return open('{', layout); }
    JsonWriter& end_object() { return close('}'); }
    JsonWriter& begin_array(Layout layout = Layout::line) { return open('[', layout); }
    JsonWriter& end_array() { return close(']'); }
    JsonWriter& key(std::string_view name);

    JsonWriter& text(std::string_view value);
    JsonWriter& number(float value);   ///< as short as gives it back; one that is not finite as "inf", "-inf" or "nan"
    JsonWriter& number(double value);  ///< nine digits, for measurements; null when it is not finite
    JsonWriter& whole(std::uint64_t value);
    JsonWriter& flag(bool value);
    JsonWriter& null();
    JsonWriter& vector(const glm::vec3& value);
    JsonWriter& line_break();  ///< before a member or a value, for whoever reads the file

    [[nodiscard]] const std::string& result() const { return text_; }

private:
    struct Level {
        Layout layout = Layout::line;
        bool needs_comma = false;
    };

    JsonWriter& open(char bracket, Layout layout);
    JsonWriter& close(char bracket);
    JsonWriter& raw(std::string_view value);
    void separate();
    void indent();

    std::string text_;
    std::vector<Level> levels_{Level{}};
    bool after_key_ = false;
};

}  // namespace raysteps
