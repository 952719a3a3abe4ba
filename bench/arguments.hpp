#pragma once
// The command line of raysteps-bench.
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace raysteps::bench {

class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Words, and options that each have a value: `scene.nff --rounds 5`.
class Arguments {
public:
    /// Throws UsageError for an option that is not among the known ones, or has no value.
    Arguments(const std::vector<std::string>& words, const std::vector<std::string>& known_options);

    [[nodiscard]] const std::vector<std::string>& words() const { return words_; }
    [[nodiscard]] std::string text(const std::string& option, const std::string& otherwise) const;
    [[nodiscard]] int number(const std::string& option, int otherwise, int least, int most) const;
    /// The parts between commas; nothing when the option is not there.
    [[nodiscard]] std::vector<std::string> list(const std::string& option) const;

private:
    std::vector<std::string> words_;
    std::map<std::string, std::string> options_;
};

}  // namespace raysteps::bench
