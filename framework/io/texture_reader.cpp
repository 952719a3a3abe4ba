#include "io/texture_reader.hpp"

#include <array>
#include <cmath>
#include <memory>

#include "io/files.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO  // files are read by read_file
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace raysteps {
namespace {

constexpr int k_largest_texture = 8192;

/// The light of each byte (IEC 61966-2-1).
std::array<float, 256> light_of_bytes(bool linear) {
    std::array<float, 256> lights{};
    for (std::size_t byte = 0; byte < lights.size(); ++byte) {
        const float c = static_cast<float>(byte) / 255.0F;
        lights.at(byte) = linear ? c : c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
    }
    return lights;
}

}  // namespace

Texture read_texture(const std::filesystem::path& path, bool linear) {
    return read_texture(read_file(path), display_name(path), linear);
}

Texture read_texture(std::string_view bytes, const std::string& name, bool linear) {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
        throw ReadError(name, "a picture as PNG or JPEG", "something else");
    }
    if (width > k_largest_texture || height > k_largest_texture) {
        throw ReadError(name, "a picture of 8192 x 8192 at most",
                        std::to_string(width) + " x " + std::to_string(height));
    }
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, size, &width, &height, &channels, 3), stbi_image_free);
    if (pixels == nullptr) {
        throw ReadError(name, "a whole picture", "one that is damaged");
    }
    const std::array<float, 256> lights = light_of_bytes(linear);
    Texture texture{.width = width, .height = height, .texels = {}};
    const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (std::size_t i = 0; i < texels; ++i) {
        const stbi_uc* pixel = pixels.get() + 3 * i;
        texture.texels.emplace_back(lights.at(pixel[0]), lights.at(pixel[1]), lights.at(pixel[2]));
    }
    return texture;
}

}  // namespace raysteps
