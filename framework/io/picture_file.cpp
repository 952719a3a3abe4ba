#include "io/picture_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "io/files.hpp"
#include "io/ppm.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO  // files are written by write_file
#include <stb_image_write.h>

namespace raysteps {
namespace {

void append(void* bytes, void* data, int size) {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

bool is_png(const std::filesystem::path& path) {
    std::string ending = display_name(path.extension());
    std::transform(ending.begin(), ending.end(), ending.begin(), [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    });
    return ending == ".png";
}

}  // namespace

std::string png_bytes(const Image& image) {
    constexpr int k_channels = 3;
    static_assert(sizeof(Rgb8) == k_channels);
    std::string bytes;
    if (stbi_write_png_to_func(append, &bytes, image.width(), image.height(), k_channels, image.pixels().data(),
                               k_channels * image.width()) == 0) {
        throw std::runtime_error("there is no memory for the picture as PNG");
    }
    return bytes;
}

void write_picture(const Image& image, const std::filesystem::path& path) {
    write_file(path, is_png(path) ? png_bytes(image) : ppm_bytes(image));
}

}  // namespace raysteps
