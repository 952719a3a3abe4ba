// What is hard to write in JSON: text with quotes, and numbers that are none.
#include "inspect/json_writer.hpp"

#include <limits>

#include "testing/testing.hpp"

using namespace raysteps;

TEST_CASE("Text is escaped, and commas come by themselves", "[inspect]") {
    JsonWriter json;
    json.begin_object().key("a\"b").text("c:\\d\n").key("list").begin_array().whole(1).flag(true).null().end_array();
    json.key("empty").begin_object().end_object().end_object();
    CHECK(json.result() == R"({"a\"b": "c:\\d\u000a", "list": [1, true, null], "empty": {}})");
}

TEST_CASE("Numbers that are not finite become words", "[inspect]") {
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    JsonWriter json;
    json.begin_array().number(0.1F).number(k_infinity).number(-k_infinity);
    json.number(std::numeric_limits<float>::quiet_NaN()).end_array();
    CHECK(json.result() == R"([0.1, "inf", "-inf", "nan"])");
}
