// Numbers from text: every double is the nearest one, by the short way and by the long one.
#include "io/numbers.hpp"

#include <cmath>
#include <limits>

#include "testing/testing.hpp"

using namespace raysteps;

namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("Numbers are read to the last bit", "[io][numbers]") {
    CHECK(parse_number("-7.33720822") == -7.33720822);
    CHECK(parse_number("+.5") == 0.5);
    CHECK(parse_number("5.") == 5.0);
    CHECK(parse_number("1e-3") == 1e-3);
    CHECK(parse_number("2.5E+2") == 250.0);
    CHECK(parse_number("0.1") == 0.1);
    INFO("at the ends of what one product of two doubles can give, and beyond");
    CHECK(parse_number("9007199254740993") == 9007199254740992.0);
    CHECK(parse_number("9007199254740992e22") == 9007199254740992e22);
    CHECK(parse_number("1e23") == 1e23);
    CHECK(parse_number("8.5e-23") == 8.5e-23);
    CHECK(parse_number("1234567890123456789012345") == 1234567890123456789012345.0);
    CHECK(parse_number("0.3333333333333333333333333333") == 1.0 / 3.0);
    CHECK(parse_number("4.9e-324") == 4.9e-324);
}

TEST_CASE("Numbers keep their sign, also 0 and what is too large or too small", "[io][numbers]") {
    CHECK(std::signbit(parse_number("-0").value_or(1.0)));
    CHECK(std::signbit(parse_number("-1e-999").value_or(1.0)));
    CHECK_FALSE(std::signbit(parse_number("0").value_or(-1.0)));
    CHECK(parse_number("1e999") == k_infinity);
    CHECK(parse_number("-1e99999999999999999999") == -k_infinity);
    CHECK(parse_number("1e-99999999999999999999") == 0.0);
    CHECK(parse_number("0e99999999999999999999") == 0.0);
}

TEST_CASE("What is no number is not read as one", "[io][numbers]") {
    for (const char* text : {"",      "+",   "-",   ".",   "-.",   "e5",  ".e5",  "1e", "1e+", "1e5e", "1e5.0", "1..2",
                             "1.2.3", "+-1", "--1", "inf", "-inf", "nan", "0x10", "1f", "1,5", " 1",   "1 "}) {
        INFO("`" << text << "`");
        CHECK_FALSE(parse_number(text).has_value());
    }
    CHECK(parse_number(std::string(100, '1')).has_value());
    CHECK_FALSE(parse_number(std::string(101, '1')).has_value());
}

TEST_CASE("A float is written in as few characters as give it back", "[io][numbers]") {
    CHECK(number_text(0.1F) == "0.1");
    CHECK(number_text(-0.0F) == "-0");
    CHECK(number_text(16777216.0F) == "16777216");
    CHECK(number_text(std::numeric_limits<float>::max()) == "3.4028235e+38");
    CHECK(number_text(-std::numeric_limits<float>::infinity()) == "-inf");
    CHECK(number_text(std::numeric_limits<float>::quiet_NaN()) == "nan");
}

TEST_CASE("Digits are cut off where fewer are wanted", "[io][numbers]") {
    CHECK(number_text(2.0 / 3.0, 3) == "0.667");
    CHECK(number_text(2.0, 9) == "2");
    CHECK(number_text(1234567.0, 3) == "1.23e+06");
}
