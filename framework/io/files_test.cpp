// Files are written whole or not at all.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/files.hpp"
#include "testing/catch.hpp"
#include "testing/temporary_folder.hpp"

using namespace raysteps;

namespace fs = std::filesystem;

TEST_CASE("a file is made or replaced, byte for byte", "[write_file]") {
    const testing::TemporaryFolder folder;
    const std::string bytes("a\r\n\0b\x1a", 6);
    write_file(folder / "out", "something longer than that");
    write_file(folder / "out", bytes);
    CHECK(read_file(folder / "out") == bytes);
    CHECK(folder.files() == 1);
}

TEST_CASE("a text in UTF-16 is refused in words", "[read_text]") {
    const testing::TemporaryFolder folder;
    for (const std::string_view start : {"\xff\xfe", "\xfe\xff", ""}) {
        write_file(folder / "scene.nff", std::string(start) + std::string("\0v\0\n", 4));
        CHECK_THROWS_WITH(read_text(folder / "scene.nff"),
                          display_name(folder / "scene.nff") +
                              ":1:1: expected a text in UTF-8, found one in UTF-16: save it in UTF-8");
    }
    write_file(folder / "scene.nff", "v\xc3\xbc");
    CHECK(read_text(folder / "scene.nff") == "v\xc3\xbc");
}

TEST_CASE("a failure leaves nothing behind and says which file", "[write_file]") {
    const testing::TemporaryFolder folder;
    fs::create_directory(folder / "taken");
    CHECK_THROWS_WITH(write_file(folder / "taken", "x"),
                      display_name(folder / "taken") + ": cannot be written: it is a directory");
    CHECK_THROWS_AS(write_file(folder / "no-such-folder" / "out", "x"), std::runtime_error);
    CHECK(folder.files() == 1);
}

#ifndef _WIN32
TEST_CASE("a link is followed and a device is not replaced", "[write_file]") {
    const testing::TemporaryFolder folder;
    write_file(folder / "target", "old");
    fs::create_symlink("target", folder / "link");
    write_file(folder / "link", "new");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(read_file(folder / "target") == "new");
    write_file("/dev/null", "x");
    CHECK(fs::is_character_file("/dev/null"));
}
#endif

#ifdef __linux__
TEST_CASE("an open file without a name is written by way of /dev/fd", "[write_file]") {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
    REQUIRE(file != nullptr);
    const fs::path path = "/dev/fd/" + std::to_string(fileno(file.get()));
    write_file(path, "to be cut short");
    write_file(path, "bytes");
    CHECK(read_file(path) == "bytes");
}
#endif
