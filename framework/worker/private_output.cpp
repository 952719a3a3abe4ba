#include "worker/private_output.hpp"

#include <stdexcept>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#else
#include <unistd.h>
#endif

namespace raysteps {
namespace {

#ifdef _WIN32
std::FILE* copy_of_stdout() {
    const int copy = _dup(1);
    _setmode(copy, _O_BINARY);  // each line ends with one character
    _dup2(2, 1);
    return copy < 0 ? nullptr : _fdopen(copy, "wb");
}
#else
std::FILE* copy_of_stdout() {
    const int copy = dup(1);
    dup2(2, 1);
    return copy < 0 ? nullptr : fdopen(copy, "wb");
}
#endif

}  // namespace

void read_stdin_as_bytes() {
#ifdef _WIN32
    _setmode(0, _O_BINARY);
#endif
}

PrivateOutput::PrivateOutput() : file_(copy_of_stdout()) {
    if (file_ == nullptr) {
        throw std::runtime_error("there is no stdout to answer on");
    }
}

PrivateOutput::~PrivateOutput() { std::fclose(file_); }

void PrivateOutput::line(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), file_);
    std::fputc('\n', file_);
    std::fflush(file_);
}

}  // namespace raysteps
