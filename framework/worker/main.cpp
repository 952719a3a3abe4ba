// Answers cases, one a line, with the functions that it is linked with. It knows no right answer: the judge, in
// another process, compares. docs/judge.md describes the lines.
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "worker/functions.hpp"

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#else
#include <unistd.h>
#endif

namespace {

using namespace raysteps;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

#ifdef _WIN32
File copy_of_stdout() {
    const int copy = _dup(1);
    _setmode(copy, _O_BINARY);  // each line ends with one character
    _dup2(2, 1);
    return File(copy < 0 ? nullptr : _fdopen(copy, "wb"));
}
#else
File copy_of_stdout() {
    const int copy = dup(1);
    dup2(2, 1);
    return File(copy < 0 ? nullptr : fdopen(copy, "wb"));
}
#endif

// Takes the real stdout away, so that what a step prints goes to stderr and never between the answers.
class PrivateOutput {
public:
    PrivateOutput() : file_(copy_of_stdout()) {
        if (file_ == nullptr) {
            throw std::runtime_error("there is no stdout to answer on");
        }
    }

    // One line, at once: what comes after it may crash.
    void line(const std::string& text) {
        std::fwrite(text.data(), 1, text.size(), file_.get());
        std::fputc('\n', file_.get());
        std::fflush(file_.get());
    }

private:
    File file_;
};

// On Windows, stdin would end at a byte 26 and lose bytes 13: from now on it is read as it is.
void read_stdin_as_bytes() {
#ifdef _WIN32
    _setmode(0, _O_BINARY);
#endif
}

// All of it before the first case runs: what a step reads from stdin is not a case.
std::vector<std::string> read_lines(std::FILE* file) {
    std::string text;
    char buffer[1 << 16];
    for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, file)) > 0;) {
        text.append(buffer, got);
    }
    std::vector<std::string> lines;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = text.find('\n', start);
        lines.push_back(text.substr(start, end == std::string::npos ? end : end - start));
        start = end == std::string::npos ? text.size() : end + 1;
    }
    return lines;
}

// Without line ends and control characters, and not without end.
std::string one_line(std::string text) {
    text.resize(text.size() < 200 ? text.size() : 200);
    for (char& c : text) {
        c = c < ' ' || c > '~' ? '?' : c;
    }
    return text;
}

std::string answer_to(const std::string& function, TokenReader& words) {
    try {
        TokenWriter answer;
        answer_case(function, words, answer);
        return answer.text();
    } catch (const ProtocolError& error) {
        return std::string(" bad-case ") + one_line(error.what());
    } catch (const std::exception& error) {
        return std::string(" threw ") + one_line(error.what());
    } catch (...) {
        return " threw something that is no std::exception";
    }
}

void answer_all(const std::vector<std::string>& lines, PrivateOutput& output) {
    for (const std::string& line : lines) {
        TokenReader words(line);
        const std::string id = words.word();
        const std::string function = words.word();
        output.line("start " + id);
        output.line("done " + id + answer_to(function, words));
    }
    output.line("end " + std::to_string(lines.size()));
}

}  // namespace

int main() {
    try {
        PrivateOutput output;
        read_stdin_as_bytes();
        answer_all(read_lines(stdin), output);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "worker: %s\n", error.what());
    }
    return 2;
}
