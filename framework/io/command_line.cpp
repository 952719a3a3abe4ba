#include "io/command_line.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <numeric>

#include "io/files.hpp"
#include "io/numbers.hpp"

namespace raysteps {
namespace {

/// Such as --step; -5 is a number.
bool looks_like_option(const std::string& word) {
    return word.starts_with('-') && (word.size() == 1 || !is_digit(word[1]));
}

/// How many characters must be put in, left out, changed or swapped with the next to make the one of the other
/// (optimal string alignment).
std::size_t edit_distance(std::string_view one, std::string_view other) {
    std::vector<std::size_t> before(other.size() + 1);  // the row above the last one
    std::vector<std::size_t> last(other.size() + 1);
    std::vector<std::size_t> row(other.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < one.size(); ++i) {
        before.swap(last);
        last.swap(row);
        row[0] = i + 1;
        for (std::size_t j = 0; j < other.size(); ++j) {
            row[j + 1] = std::min({last[j] + (one[i] == other[j] ? 0U : 1U), row[j] + 1, last[j + 1] + 1});
            if (i > 0 && j > 0 && one[i] == other[j - 1] && one[i - 1] == other[j]) {
                row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
            }
        }
    }
    return row.back();
}

}  // namespace

void refuse(std::string_view option, const std::string& expected, const std::string& found) {
    throw UsageError(std::string(option) + ": expected " + expected + ", found '" + found + "'");
}

std::vector<int> numbers_in(std::string_view text, char separator, std::size_t count) {
    std::vector<int> values;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) {
            if (at == end || *at != separator) {
                return {};
            }
            ++at;
        }
        int value = 0;
        const auto [after, error] = std::from_chars(at, end, value);
        if (error != std::errc{}) {
            return {};
        }
        values.push_back(value);
        at = after;
    }
    return at == end ? values : std::vector<int>{};
}

int number_between(std::string_view option, const std::string& text, int least, int most) {
    const std::vector<int> values = numbers_in(text, ' ', 1);
    if (values.empty() || values.front() < least || values.front() > most) {
        refuse(option, "a whole number from " + std::to_string(least) + " to " + std::to_string(most), text);
    }
    return values.front();
}

std::string join_or(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

CommandLine& CommandLine::option(const std::string& name, Setter set) {
    options_[name] = std::move(set);
    return *this;
}

CommandLine& CommandLine::option(const std::string& name, std::string& text) {
    return option(name, [&text](const std::string& value) { text = value; });
}

CommandLine& CommandLine::number(const std::string& name, int& number, int least, int most) {
    return option(name, [=, &number](const std::string& text) { number = number_between(name, text, least, most); });
}

CommandLine& CommandLine::flag(const std::string& name, bool& set) {
    flags_[name] = {.set = &set, .ends = false};
    return *this;
}

CommandLine& CommandLine::ending(const std::string& name, bool& set) {
    flags_[name] = {.set = &set, .ends = true};
    return *this;
}

std::vector<std::string> CommandLine::parse(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        const auto option = options_.find(argument);
        const auto flag = flags_.find(argument);
        if (option != options_.end()) {
            if (i + 1 == arguments.size()) {
                throw UsageError(argument + ": expected a value after it");
            }
            option->second(arguments[++i]);
        } else if (flag != flags_.end()) {
            *flag->second.set = true;
            if (flag->second.ends) {
                return words;
            }
        } else if (looks_like_option(argument)) {
            const std::string meant = nearest(argument.substr(0, argument.find('=')));
            throw UsageError(argument + ": there is no such option" +
                             (meant.empty() ? "; expected " + expected_ : "; did you mean " + meant + "?"));
        } else if (words.size() == max_words_) {
            refuse("arguments", expected_, argument);
        } else {
            words.push_back(argument);
        }
    }
    return words;
}

std::string CommandLine::nearest(const std::string& word) const {
    std::string nearest;
    std::size_t least = 3;  // from here on it is another word
    const auto look_at = [&](const std::string& name) {
        const std::size_t distance = edit_distance(word, name);
        if (name.size() > least && distance < least) {
            nearest = name;
            least = distance;
        } else if (distance == least && !nearest.empty()) {
            nearest += " or " + name;
        }
    };
    for (const auto& [name, setter] : options_) {
        look_at(name);
    }
    for (const auto& [name, flag] : flags_) {
        look_at(name);
    }
    return nearest;
}

int run_program(const char* command, const std::function<void()>& work) {
    constexpr int k_exit_usage = 2;
    try {
        work();
        return 0;
    } catch (const ReadError& error) {
        std::fprintf(stderr, "%s\n", error.what());
    } catch (const UsageError& error) {
        std::fprintf(stderr, "raysteps %s: %s\nAll options: ./raysteps %s --help\n", command, error.what(), command);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raysteps %s: %s\n", command, error.what());
    } catch (...) {  // a student's function may throw anything
        std::fprintf(stderr, "raysteps %s: something was thrown that is no std::exception\n", command);
    }
    return k_exit_usage;
}

}  // namespace raysteps
