#include "io/read_file.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "io/read_error.hpp"

namespace raysteps {
namespace {

constexpr std::size_t k_most_bytes = std::size_t{1} << 30U;

void refuse_what_is_no_file(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        throw ReadError(display_name(path), "a file", "nothing of that name");
    }
    if (std::filesystem::is_directory(status)) {
        throw ReadError(display_name(path), "a file", "a directory");
    }
}

// A hint only: a pipe has no size, and a file may grow.
std::string with_room_for(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    std::string bytes;
    if (!error && size <= k_most_bytes) {
        bytes.reserve(static_cast<std::size_t>(size));
    }
    return bytes;
}

}  // namespace

std::string display_name(const std::filesystem::path& path) {
    const std::u8string name = path.u8string();
    return {name.begin(), name.end()};
}

// Read in pieces and not by file size: a pipe has none.
std::string read_file(const std::filesystem::path& path) {
    refuse_what_is_no_file(path);
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw ReadError(display_name(path), "a file that can be read", "one that cannot be opened");
    }
    std::string bytes = with_room_for(path);
    std::array<char, 65536> piece{};
    while (file) {
        file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        bytes.append(piece.data(), static_cast<std::size_t>(file.gcount()));
        if (bytes.size() > k_most_bytes) {
            throw ReadError(display_name(path), "a file of at most 1 GiB", "a larger one");
        }
    }
    if (file.bad()) {
        throw ReadError(display_name(path), "a file that can be read", "a read error");
    }
    return bytes;
}

}  // namespace raysteps
