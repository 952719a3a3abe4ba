// Answers cases, one a line, with the functions that it is linked with. It knows no right answer: the judge, in
// another process, compares. docs/judge.md describes the lines.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "worker/functions.hpp"
#include "worker/private_output.hpp"

namespace {

using namespace raysteps;

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

std::string answer_to(const std::string& function, Words& words) {
    try {
        Answer answer;
        answer_case(function, words, answer);
        return answer.text();
    } catch (const BadCase& error) {
        return std::string(" bad-case ") + one_line(error.what());
    } catch (const std::exception& error) {
        return std::string(" threw ") + one_line(error.what());
    } catch (...) {
        return " threw something that is no std::exception";
    }
}

void answer_all(const std::vector<std::string>& lines, PrivateOutput& output) {
    for (const std::string& line : lines) {
        Words words(line);
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
