#pragma once
// JSON, piece by piece.
#include <cstdint>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace raysteps {

/// Writes values one after the other; commas come by themselves.
class JsonWriter {
public:
    JsonWriter& begin_object();
    JsonWriter& end_object();
    JsonWriter& begin_array();
    JsonWriter& end_array();
    JsonWriter& key(std::string_view name);

    JsonWriter& text(std::string_view value);
    JsonWriter& number(float value);  ///< one that is not finite becomes "inf", "-inf" or "nan"
    JsonWriter& whole(std::uint64_t value);
    JsonWriter& flag(bool value);
    JsonWriter& null();
    JsonWriter& vector(const glm::vec3& value);
    JsonWriter& line_break();  ///< for whoever reads the file

    [[nodiscard]] const std::string& result() const { return text_; }

private:
    JsonWriter& raw(std::string_view value);
    void separate();

    std::string text_;
    bool needs_comma_ = false;
};

}  // namespace raysteps
