// What is hard to write in JSON: text with quotes, and numbers that are none.
#include "io/json_writer.hpp"

#include <limits>

#include "testing/testing.hpp"

using namespace raysteps;

TEST_CASE("Text is escaped, and commas come by themselves", "[io]") {
    JsonWriter json;
    json.begin_object().key("a\"b").text("c:\\d\n").key("list").begin_array().whole(1).flag(true).null().end_array();
    json.key("empty").begin_object().end_object().end_object();
    CHECK(json.result() == R"({"a\"b": "c:\\d\u000a", "list": [1, true, null], "empty": {}})");
}

TEST_CASE("Numbers that are not finite become words", "[io]") {
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    JsonWriter json;
    json.begin_array().number(0.1F).number(k_infinity).number(-k_infinity);
    json.number(std::numeric_limits<float>::quiet_NaN()).end_array();
    CHECK(json.result() == R"([0.1, "inf", "-inf", "nan"])");
}

TEST_CASE("Members of a block stand on lines of their own", "[io]") {
    JsonWriter json;
    json.begin_object(JsonWriter::Layout::block).key("rays").begin_object().key("eye").whole(1).key("all").whole(2);
    json.end_object().key("empty").begin_array(JsonWriter::Layout::block).end_array().key("list");
    json.begin_array(JsonWriter::Layout::block).number(0.25).number(1.0 / 3.0).end_array().end_object();
    CHECK(json.result() == R"({
  "rays": {"eye": 1, "all": 2},
  "empty": [],
  "list": [
    0.25,
    0.333333333
  ]
})");
}

TEST_CASE("A reader's line break takes the place of a blank", "[io]") {
    JsonWriter json;
    json.begin_array().whole(1).line_break().whole(2).whole(3).end_array();
    CHECK(json.result() == "[1,\n2, 3]");
    JsonWriter object;
    object.begin_object().key("a").line_break().whole(1).line_break().key("b").whole(2).end_object();
    CHECK(object.result() == "{\"a\": \n1,\n\"b\": 2}");
}
