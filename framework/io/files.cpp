#include "io/files.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <random>
#include <system_error>

namespace raysteps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_longest_quote = 20;

std::string sentence(std::string_view where, std::string_view expected, std::string_view found) {
    std::string text(where);
    text.append(": expected ").append(expected).append(", found ").append(found);
    return text;
}

// One character of a message: itself when it is printable ASCII, else \xNN.
std::string printable(char character) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte >= 0x20 && byte < 0x7f) {
        return {character};
    }
    constexpr std::string_view k_digits = "0123456789abcdef";
    return {'\\', 'x', k_digits[byte / 16U], k_digits[byte % 16U]};
}

constexpr std::size_t k_max_bytes = std::size_t{1} << 30U;

void refuse_what_is_no_file(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) {
        throw ReadError(display_name(path), "a file", "nothing of that name");
    }
    if (fs::is_directory(status)) {
        throw ReadError(display_name(path), "a file", "a directory");
    }
}

// A hint only: a pipe has no size, and a file may grow.
std::string with_room_for(const fs::path& path) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    std::string bytes;
    if (!error && size <= k_max_bytes) {
        bytes.reserve(static_cast<std::size_t>(size));
    }
    return bytes;
}

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
    throw std::runtime_error(display_name(path) + ": cannot be written: " + why);
}

bool write_bytes(const fs::path& path, std::string_view bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    return !file.fail();
}

// Random, so that two programs that write the same file do not meet.
fs::path temporary_name(const fs::path& target) {
    std::random_device random;
    fs::path name = target;
    name += "." + std::to_string(random()) + ".tmp";
    return name;
}

// What a link points to, so that the rename replaces the file and not the link. A link whose target has no name, as
// /dev/fd/3 may be, stands for itself.
fs::path behind_links(const fs::path& path) {
    std::error_code error;
    const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
    const bool has_no_name = fs::exists(path, error) && !fs::exists(target, error);
    return error || has_no_name ? path : target;
}

// What cannot be replaced is overwritten: a device, or an open file that /dev/fd names.
bool must_be_overwritten(const fs::path& target, const fs::file_status& status) {
    std::error_code error;
    return fs::exists(status) && (!fs::is_regular_file(status) || fs::is_symlink(target, error));
}

}  // namespace

std::string place(std::string_view file, std::size_t line, std::size_t column) {
    return std::string(file) + ":" + std::to_string(line) + ":" + std::to_string(column);
}

ReadError::ReadError(std::string_view file, std::string_view expected, std::string_view found)
    : std::runtime_error(sentence(file, expected, found)) {}

ReadError::ReadError(std::string_view file, std::size_t line, std::size_t column, std::string_view expected,
                     std::string_view found)
    : std::runtime_error(sentence(place(file, line, column), expected, found)) {}

std::string quoted(std::string_view text) {
    std::string shown;
    for (const char character : text) {
        const std::string next = printable(character);
        if (shown.size() + next.size() > k_longest_quote) {
            return "`" + shown + "...`";
        }
        shown += next;
    }
    return "`" + shown + "`";
}

fs::path path_of(std::string_view utf8) { return {std::u8string(utf8.begin(), utf8.end())}; }

std::string display_name(const fs::path& path) {
    const std::u8string name = path.u8string();
    return {name.begin(), name.end()};
}

// Read in pieces and not by file size: a pipe has none.
std::string read_file(const fs::path& path) {
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
        if (bytes.size() > k_max_bytes) {
            throw ReadError(display_name(path), "a file of at most 1 GiB", "a larger one");
        }
    }
    if (file.bad()) {
        throw ReadError(display_name(path), "a file that can be read", "a read error");
    }
    return bytes;
}

std::string read_text(const fs::path& path) {
    std::string text = read_file(path);
    const bool is_marked = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
    const bool is_bare = text.size() > 1 && (text[0] == '\0') != (text[1] == '\0');  // half of each letter is empty
    if (is_marked || is_bare) {
        throw ReadError(display_name(path), 1, 1, "a text in UTF-8", "one in UTF-16: save it in UTF-8");
    }
    return text;
}

void write_file(const fs::path& path, std::string_view bytes) {
    const fs::path target = behind_links(path);
    std::error_code error;
    const fs::file_status status = fs::status(target, error);
    if (fs::is_directory(status)) {
        fail(path, "it is a directory");
    }
    if (must_be_overwritten(target, status)) {
        if (!write_bytes(target, bytes)) {
            fail(path, "the device refused it");
        }
        return;
    }
    const fs::path temporary = temporary_name(target);
    const bool written = write_bytes(temporary, bytes);
    error.clear();
    if (written) {
        fs::rename(temporary, target, error);
    }
    if (!written || error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        fail(path, error ? error.message() : "no such folder, no permission or no space");
    }
}

}  // namespace raysteps
