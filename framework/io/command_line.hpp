#pragma once
// What people type after a program's name, and what they are told when it is wrong.
#include <cstddef>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raysteps {

/// What was typed cannot be done. The message says what was expected and what was found.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws UsageError: `option: expected ..., found '...'`.
[[noreturn]] void refuse(std::string_view option, const std::string& expected, const std::string& found);

/// A whole number; throws UsageError for one out of range and for any other text.
[[nodiscard]] int number_between(std::string_view option, const std::string& text, int least, int most);

/// `count` whole numbers of any size, parted by the separator: 320x240. Nothing for any other text, so that the caller
/// can say what it expects.
[[nodiscard]] std::vector<int> numbers_in(std::string_view text, char separator, std::size_t count);

/// `a, b or c`
[[nodiscard]] std::string join_or(const std::vector<std::string>& words);

/// The options of one program, each with the variable that its value goes to; these must outlive it.
class CommandLine {
public:
    using Setter = std::function<void(const std::string&)>;

    /// `expected` tells who types a word too many, or an option that is none, what the program takes.
    CommandLine(std::size_t words, std::string expected) : max_words_(words), expected_(std::move(expected)) {}

    /// An option with a value that `set` understands, or throws UsageError.
    CommandLine& option(const std::string& name, Setter set);
    CommandLine& option(const std::string& name, std::string& text);
    CommandLine& number(const std::string& name, int& number, int least, int most);

    /// One of several words, each of which stands for a value. They are told in this order.
    template <class Value, class Target>
    CommandLine& choice(const std::string& name, Target& target, std::vector<std::pair<std::string, Value>> values) {
        return option(name, [name, &target, values = std::move(values)](const std::string& text) {
            std::vector<std::string> names;
            for (const auto& [word, value] : values) {
                if (word == text) {
                    target = value;
                    return;
                }
                names.push_back(word);
            }
            refuse(name, join_or(names), text);
        });
    }

    /// An option without a value.
    CommandLine& flag(const std::string& name, bool& set);
    /// As flag; whatever else is typed no longer matters: --help.
    CommandLine& ending(const std::string& name, bool& set);

    /// Sets what was typed, and returns the words that are no options, in their order. A number below 0 is a word.
    /// Throws UsageError.
    [[nodiscard]] std::vector<std::string> parse(const std::vector<std::string>& arguments) const;

private:
    struct Flag {
        bool* set = nullptr;
        bool ends = false;
    };

    /// The option that may have been meant, or several as near; nothing where none is like it.
    [[nodiscard]] std::string nearest(const std::string& word) const;

    std::size_t max_words_;
    std::string expected_;
    std::map<std::string, Setter> options_;
    std::map<std::string, Flag> flags_;
};

/// Runs a program's work and gives its exit code: 2 for whatever it throws, such as bad arguments, a bad scene, a file
/// that cannot be written, or an exception of a step.
/// What was wrong is told on stderr; `command` is what a person types after ./raysteps.
[[nodiscard]] int run_program(const char* command, const std::function<void()>& work);

}  // namespace raysteps
