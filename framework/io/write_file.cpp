#include "io/write_file.hpp"

#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>

#include "io/read_file.hpp"

namespace raysteps {
namespace {

namespace fs = std::filesystem;

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
