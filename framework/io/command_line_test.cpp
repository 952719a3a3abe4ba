// What is typed after a program's name.
#include "io/command_line.hpp"

#include <optional>

#include "testing/testing.hpp"

using namespace raysteps;

namespace {

struct Typed {
    std::string text;
    int number = 1;
    std::optional<char> letter;
    bool loud = false;
    bool help = false;
    std::vector<std::string> words;
};

Typed typed(const std::vector<std::string>& arguments) {
    Typed result;
    CommandLine line(2, "two words");
    line.option("-o", result.text).number("--number", result.number, -3, 10).flag("--loud", result.loud);
    line.choice<char>("--letter", result.letter, {{"a", 'A'}, {"b", 'B'}, {"c", 'C'}});
    line.ending("--help", result.help);
    result.words = line.parse(arguments);
    return result;
}

std::string complaint_about(const std::vector<std::string>& arguments) {
    try {
        static_cast<void>(typed(arguments));
    } catch (const UsageError& error) {
        return error.what();
    }
    return "no complaint";
}

}  // namespace

TEST_CASE("Words and options come in any order", "[io]") {
    const Typed result = typed({"one", "--number", "-2", "--loud", "-5", "-o", "--loud", "--letter", "b"});
    CHECK(result.words == std::vector<std::string>{"one", "-5"});
    CHECK(result.number == -2);
    CHECK(result.text == "--loud");
    CHECK(result.letter == 'B');
    CHECK(result.loud);
    CHECK_FALSE(result.help);
}

TEST_CASE("After --help nothing matters", "[io]") {
    CHECK(typed({"--help", "--number", "many", "--no-such-option"}).help);
}

TEST_CASE("A wrong command line is answered with what was expected and what was found", "[io]") {
    CHECK(complaint_about({"--number"}) == "--number: expected a value after it");
    CHECK(complaint_about({"--number", "11"}) == "--number: expected a whole number from -3 to 10, found '11'");
    CHECK(complaint_about({"--number", "2 "}) == "--number: expected a whole number from -3 to 10, found '2 '");
    CHECK(complaint_about({"--letter", "d"}) == "--letter: expected a, b or c, found 'd'");
    CHECK(complaint_about({"--quiet"}) == "--quiet: there is no such option; expected two words");
    CHECK(complaint_about({"-"}) == "-: there is no such option; expected two words");
    CHECK(complaint_about({"--nubmer", "3"}) == "--nubmer: there is no such option; did you mean --number?");
    CHECK(complaint_about({"--ltetre", "b"}) == "--ltetre: there is no such option; did you mean --letter?");
    CHECK(complaint_about({"--lettre=b"}) == "--lettre=b: there is no such option; did you mean --letter?");
    CHECK(complaint_about({"1", "2", "3"}) == "arguments: expected two words, found '3'");
}

TEST_CASE("All options that may have been meant are told", "[io]") {
    std::string text;
    CommandLine line(0, "nothing");
    line.option("--sampler", text).option("--samples", text).option("--seed", text);
    CHECK_THROWS_WITH(line.parse({"--sample", "4"}),
                      "--sample: there is no such option; did you mean --sampler or --samples?");
}

TEST_CASE("Numbers in a row have one separator between two", "[io]") {
    CHECK(numbers_in("320x240", 'x', 2) == std::vector<int>{320, 240});
    for (const char* text : {"", "320", "320x", "x240", "320x240x1", "320,240", "320x 240", "99999999999x1"}) {
        INFO("`" << text << "`");
        CHECK(numbers_in(text, 'x', 2).empty());
    }
}
