// Fuzz target for the readers of scenes, meshes and pictures. Any bytes are either read or refused with a ReadError;
// what the kit can write survives being written and read again.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "io/nff_reader.hpp"
#include "io/nff_writer.hpp"
#include "io/obj_reader.hpp"
#include "io/pbrt_reader.hpp"
#include "io/ply_reader.hpp"
#include "io/ppm.hpp"
#include "io/texture_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using raysteps::Image;
using raysteps::ReadError;

void require(bool condition, const char* what) {
    if (!condition) {
        std::fprintf(stderr, "readers_fuzz: failed: %s\n", what);
        std::abort();
    }
}

void require_message(const ReadError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input:"), "the message starts with the file's name");
    require(message.find(": expected ") != std::string_view::npos, "the message says what was expected");
    require(message.find(", found ") != std::string_view::npos, "the message says what was found");
    for (const char character : message) {
        require(character >= 0x20 && character < 0x7f, "the message is printable");
    }
}

void try_nff(std::string_view text) {
    std::string first;
    try {
        first = raysteps::write_nff(raysteps::read_nff(text, "input"));
    } catch (const ReadError& error) {
        require_message(error);
        return;
    }
    const std::string second = raysteps::write_nff(raysteps::read_nff(first, "input"));
    require(first == second, "an NFF scene survives writing and reading");
}

void try_ppm(std::string_view bytes) {
    Image image;
    try {
        image = raysteps::read_ppm(bytes, "input");
    } catch (const ReadError& error) {
        require_message(error);
        return;
    }
    require(raysteps::read_ppm(raysteps::ppm_bytes(image), "input") == image, "a picture survives");
}

/// Whether it is read is of no interest, only that nothing else happens.
template <typename Read>
void try_reading(const Read& read) {
    try {
        read();
    } catch (const ReadError& error) {
        require_message(error);
    }
}

void check_triangles(const raysteps::MeshData& mesh) {
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            require(corner < mesh.positions.size(), "a triangle's corner is there");
        }
    }
    require(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size(), "every corner has a normal, or none");
    require(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size(), "every corner has a place, or none");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(data, data + size);
    try_nff(bytes);
    try_ppm(bytes);
    try_reading([&] { static_cast<void>(raysteps::read_pbrt(bytes, "input")); });
    try_reading([&] { check_triangles(raysteps::read_ply(bytes, "input")); });
    try_reading([&] { check_triangles(raysteps::read_obj(bytes, "input")); });
    try_reading([&] { static_cast<void>(raysteps::read_texture(bytes, "input", false)); });
    return 0;
}
