#pragma once
// Writes JSON piece by piece; commas and indentation come by themselves.
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace raysteps::bench {

class Json {
public:
    Json();

    Json& key(std::string_view name);

    Json& begin_object() { return open('{'); }
    Json& end_object() { return close('}'); }
    Json& begin_array() { return open('['); }
    Json& end_array() { return close(']'); }

    Json& value(std::string_view text);
    Json& value(double number);
    Json& value(std::uint64_t number);
    Json& value(bool truth);
    Json& value(const std::string& text) { return value(std::string_view(text)); }
    Json& null();

    template <typename Value>
    Json& field(std::string_view name, const Value& content) {
        return key(name).value(content);
    }

    [[nodiscard]] std::string text() const { return out_.str() + "\n"; }

private:
    Json& open(char bracket);
    Json& close(char bracket);
    void begin_value();
    void write_string(std::string_view text);

    std::ostringstream out_;
    std::vector<bool> has_members_{false};
    bool after_key_ = false;
};

}  // namespace raysteps::bench
