#include "io/ppm.hpp"

#include <cstddef>
#include <cstdint>

#include "io/token_scanner.hpp"

namespace raysteps {
namespace {

constexpr int k_largest_maxval = 65535;

class PpmReader {
public:
    PpmReader(std::string_view bytes, const std::string& name)
        : bytes_(bytes), scanner_(bytes, name), fields_(scanner_) {}

    Image read() {
        const Token magic = scanner_.next();
        if (!bytes_.starts_with('P') || (magic.text != "P3" && magic.text != "P6")) {
            scanner_.fail(magic, "a PPM picture that starts with P3 or P6");
        }
        width_ = fields_.whole("width of the picture", 1, k_largest_side);
        height_ = fields_.whole("height of the picture", 1, k_largest_side);
        maxval_ = fields_.whole("maxval", 1, k_largest_maxval);
        return magic.text == "P3" ? read_text() : read_binary();
    }

private:
    [[nodiscard]] std::size_t samples() const {
        return 3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }

    [[nodiscard]] std::size_t bytes_left() const { return bytes_.size() - scanner_.offset(); }

    // Before memory is taken for the pixels: a short file must not ask for a large picture.
    void need_bytes(std::size_t count) const {
        if (bytes_left() < count) {
            scanner_.fail(scanner_.here(), std::to_string(count) + " bytes or more of pixels",
                          std::to_string(bytes_left()));
        }
    }

    [[nodiscard]] std::uint8_t scaled(int sample) const {
        return static_cast<std::uint8_t>((sample * 255 + maxval_ / 2) / maxval_);
    }

    Image read_text() {
        need_bytes(2 * samples());  // a blank and a digit each
        Image image(width_, height_);
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                Rgb8& pixel = image.at(x, y);
                for (std::uint8_t* channel : {&pixel.r, &pixel.g, &pixel.b}) {
                    *channel = scaled(fields_.whole("a sample", 0, maxval_));
                }
            }
        }
        if (const Token token = scanner_.next(); !token.is_end()) {
            scanner_.fail(token, "nothing after the last pixel");
        }
        return image;
    }

    // One white space parts the header from the pixels. Two bytes a sample, the high one first, above maxval 255.
    Image read_binary() {
        const std::size_t width = maxval_ > 255 ? 2 : 1;
        need_bytes(1 + width * samples());
        if (!is_blank(bytes_[scanner_.offset()])) {
            scanner_.fail(scanner_.here(), "one white space after maxval", quoted(bytes_.substr(scanner_.offset(), 1)));
        }
        std::size_t offset = scanner_.offset() + 1;
        Image image(width_, height_);
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                Rgb8& pixel = image.at(x, y);
                for (std::uint8_t* channel : {&pixel.r, &pixel.g, &pixel.b}) {
                    *channel = scaled(sample(offset, width));
                    offset += width;
                }
            }
        }
        check_rest(offset);
        return image;
    }

    [[nodiscard]] int sample(std::size_t offset, std::size_t width) const {
        int value = static_cast<unsigned char>(bytes_[offset]);
        if (width == 2) {
            value = value * 256 + static_cast<unsigned char>(bytes_[offset + 1]);
        }
        if (value > maxval_) {
            scanner_.fail(scanner_.here(), "samples of at most " + std::to_string(maxval_),
                          std::to_string(value) + " in byte " + std::to_string(offset + 1));
        }
        return value;
    }

    void check_rest(std::size_t offset) const {
        const std::string_view rest = bytes_.substr(offset);
        for (const char byte : rest) {
            if (!is_blank(byte)) {
                scanner_.fail(scanner_.here(), "nothing after the last pixel",
                              quoted(rest) + " from byte " + std::to_string(offset + 1));
            }
        }
    }

    std::string_view bytes_;
    TokenScanner scanner_;
    FieldReader fields_;
    int width_ = 0;
    int height_ = 0;
    int maxval_ = 0;
};

}  // namespace

Image read_ppm(const std::filesystem::path& path) { return read_ppm(read_file(path), display_name(path)); }

Image read_ppm(std::string_view bytes, const std::string& name) { return PpmReader(bytes, name).read(); }

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

}  // namespace raysteps
