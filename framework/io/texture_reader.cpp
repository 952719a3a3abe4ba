#include "io/texture_reader.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "io/files.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO  // files are read by read_file
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#ifdef __GNUC__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_image.h>
#ifdef __GNUC__
#pragma GCC diagnostic pop
#endif

namespace raysteps {
namespace {

constexpr int k_largest_texture = 8192;

/// Whether every Huffman table of a JPEG has as few codes as it may have. stb_image 2.27 and older write beyond their
/// own tables where a damaged file has more. Segments are found as stb_image finds them.
bool has_sound_tables(std::string_view bytes) {
    constexpr int k_table = 17;  // a byte of its class, and how many codes there are of each length
    constexpr int k_max_codes = 256;
    const auto byte = [&](std::size_t at) { return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0; };
    for (std::size_t at = 0; at + 1 < bytes.size(); ++at) {
        const int marker = byte(at + 1);
        const bool is_segment = byte(at) == 0xFF && marker >= 0xC0 && marker < 0xFF && (marker < 0xD0 || marker > 0xD9);
        if (!is_segment) {
            continue;
        }
        const auto length =
            std::size_t{256} * static_cast<std::size_t>(byte(at + 2)) + static_cast<std::size_t>(byte(at + 3));
        const std::size_t end = at + 2 + length;
        for (std::size_t table = at + 4; marker == 0xC4 && table < end;) {
            int codes = 0;
            for (int i = 1; i < k_table; ++i) {
                codes += byte(table + static_cast<std::size_t>(i));
            }
            if (codes > k_max_codes) {
                return false;
            }
            table += static_cast<std::size_t>(k_table + codes);
        }
        at = end > at + 2 ? end - 1 : at + 1;
    }
    return true;
}

/// The PNG without empty chunks of data, or nothing where a chunk does not lie within the file. stb_image takes as
/// much memory as a damaged one says that it has, and copies to a null pointer where the first part of the picture's
/// data is empty.
std::optional<std::string> with_sound_chunks(std::string_view png) {
    constexpr std::size_t k_signature = 8;
    constexpr std::size_t k_head = 8;     // bytes of a chunk: length and kind
    constexpr std::size_t k_around = 12;  // and, behind its data, a check sum
    std::string sound(png.substr(0, k_signature));
    std::size_t at = k_signature;
    while (at + k_around <= png.size()) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            length = 256 * length + static_cast<unsigned char>(png[at + i]);
        }
        if (length > png.size() - at - k_around) {
            return std::nullopt;
        }
        if (length > 0 || png.substr(at + 4, 4) != "IDAT") {
            sound += png.substr(at, k_around + length);
        }
        at += k_around + length;
    }
    return at + k_head > png.size() ? std::optional(std::move(sound)) : std::nullopt;
}

/// The JPEG with all eight Huffman tables defined at its start, by one code each; its own take their places. stb_image
/// reads beyond its tables where a damaged file uses one that it never defined. Nothing where a table is not sound.
std::optional<std::string> with_all_tables(std::string_view jpeg) {
    if (!has_sound_tables(jpeg)) {
        return std::nullopt;
    }
    constexpr std::size_t k_marker = 2;
    std::string tables("\xFF\xC4\x00\x92", 4);  // a segment of 146 bytes: its length, and 8 tables of 18 bytes
    for (const char table : std::string_view("\0\1\2\3\x10\x11\x12\x13", 8)) {
        tables += table;
        tables += '\x01';  // one code of length 1, none of the other lengths
        tables.append(16, '\0');
    }
    return std::string(jpeg.substr(0, k_marker)) + tables + std::string(jpeg.substr(k_marker));
}

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

std::optional<std::string> bytes_of_data_uri(std::string_view uri) {
    constexpr std::string_view k_mark = ";base64,";
    constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t mark = uri.find(k_mark);
    if (mark == std::string_view::npos) {
        return std::nullopt;
    }
    const std::string_view text = uri.substr(mark + k_mark.size());
    if (text.size() % 4 != 0) {
        return std::nullopt;  // it was cut off: three bytes are four digits, and `=` fills the last four
    }
    std::string bytes;
    unsigned bits = 0;
    unsigned known = 0;
    for (const char digit : text.substr(0, text.find_last_not_of('=') + 1)) {
        const std::size_t value = k_digits.find(digit);
        if (value == std::string_view::npos) {
            return std::nullopt;
        }
        bits = (bits << 6U | static_cast<unsigned>(value)) & 0xFFFFU;
        known += 6;
        if (known >= 8) {
            known -= 8;
            bytes += static_cast<char>(bits >> known & 0xFFU);
        }
    }
    return bytes;
}

Texture read_texture(const std::filesystem::path& path, bool linear) {
    return read_texture(read_file(path), display_name(path), linear);
}

Texture read_texture(std::string_view bytes, const std::string& name, bool linear) {
    const bool is_jpeg = bytes.starts_with("\xFF\xD8");
    if (!is_jpeg && !bytes.starts_with("\x89PNG")) {
        throw ReadError(name, "a picture as PNG or JPEG", "something else");
    }
    const std::optional<std::string> whole = is_jpeg ? with_all_tables(bytes) : with_sound_chunks(bytes);
    if (!whole) {
        throw ReadError(name, "a whole picture", "one that is damaged");
    }
    const auto* data = reinterpret_cast<const stbi_uc*>(whole->data());
    const int size = static_cast<int>(whole->size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
        throw ReadError(name, "a whole picture", "one that is damaged");
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
