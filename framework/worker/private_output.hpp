#pragma once
// A stdout of the worker's own.
#include <cstdio>
#include <string>

namespace raysteps {

/// On Windows, stdin would end at a byte 26 and lose bytes 13: from now on it is read as it is.
void read_stdin_as_bytes();

/// Takes the real stdout away, so that what a step prints goes to stderr and never between the answers.
class PrivateOutput {
public:
    PrivateOutput();  ///< throws std::runtime_error where there is no stdout
    ~PrivateOutput();
    PrivateOutput(const PrivateOutput&) = delete;
    PrivateOutput& operator=(const PrivateOutput&) = delete;

    /// One line, at once: what comes after it may crash.
    void line(const std::string& text);

private:
    std::FILE* file_;
};

}  // namespace raysteps
