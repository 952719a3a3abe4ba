#include "bench/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace raysteps::bench {

Arguments::Arguments(const std::vector<std::string>& words, const std::vector<std::string>& known_options) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (!word.starts_with("--")) {
            words_.push_back(word);
            continue;
        }
        if (std::find(known_options.begin(), known_options.end(), word) == known_options.end()) {
            throw UsageError(word + ": there is no such option");
        }
        if (i + 1 == words.size()) {
            throw UsageError(word + ": expected a value after it");
        }
        options_[word] = words[++i];
    }
}

std::string Arguments::text(const std::string& option, const std::string& otherwise) const {
    const auto found = options_.find(option);
    return found == options_.end() ? otherwise : found->second;
}

int Arguments::number(const std::string& option, int otherwise, int least, int most) const {
    const auto found = options_.find(option);
    if (found == options_.end()) {
        return otherwise;
    }
    const std::string& text = found->second;
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < least || value > most) {
        throw UsageError(option + ": expected a whole number from " + std::to_string(least) + " to " +
                         std::to_string(most) + ", found '" + text + "'");
    }
    return value;
}

std::vector<std::string> Arguments::list(const std::string& option) const {
    std::vector<std::string> parts;
    std::istringstream text(this->text(option, ""));
    for (std::string part; std::getline(text, part, ',');) {
        parts.push_back(part);
    }
    return parts;
}

}  // namespace raysteps::bench
