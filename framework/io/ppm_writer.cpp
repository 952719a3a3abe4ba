#include <cstdint>

#include "io/ppm.hpp"
#include "io/write_file.hpp"

namespace raysteps {

std::string ppm_bytes(const Image& image) {
    std::string bytes = "P6\n" + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n255\n";
    bytes.reserve(bytes.size() + 3 * image.pixels().size());
    for (const Rgb8& pixel : image.pixels()) {
        for (const std::uint8_t channel : {pixel.r, pixel.g, pixel.b}) {
            bytes += static_cast<char>(channel);
        }
    }
    return bytes;
}

void write_ppm(const Image& image, const std::filesystem::path& path) { write_file(path, ppm_bytes(image)); }

}  // namespace raysteps
