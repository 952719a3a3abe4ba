#pragma once
// The text that the worker reads and writes: words and numbers between blanks.
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace raysteps {

/// A case that nobody can run: the judge's mistake, not the student's.
class BadCase : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The words of one line, from left to right. Every reader throws BadCase where there is no such word.
class Words {
public:
    explicit Words(std::string_view line) : rest_(line) {}

    [[nodiscard]] std::string word();
    [[nodiscard]] float number();  ///< also inf, -inf and nan
    [[nodiscard]] int whole();
    [[nodiscard]] bool flag() { return whole() != 0; }
    [[nodiscard]] int count();  ///< from 0 to a million
    [[nodiscard]] glm::vec3 vector();
    void expect_end();

private:
    std::string_view rest_;
};

/// The words of an answer.
class Answer {
public:
    Answer& word(std::string_view word);
    Answer& number(float value);  ///< the shortest text that reads back as the same float
    Answer& whole(long long value);
    Answer& vector(const glm::vec3& value);

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

}  // namespace raysteps
