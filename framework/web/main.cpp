// What the page to work in runs: all programs of a step in one, so that it is linked once. The first word says which.
#include <cstdint>
#include <string_view>
#include <vector>

#include "figures.hpp"
#include "render/renderer.hpp"

int raytrace_main(int argc, char** argv);
int test_main(int argc, char** argv);

/// The page's own function: it draws a part of the picture. The pixels stand row by row, three bytes each.
[[clang::import_module("page"), clang::import_name("show_tile")]] void show_tile(int x, int y, int width, int height,
                                                                                 const std::uint8_t* pixels);

namespace {

void tell_page(const raysteps::Rect& tile, const raysteps::Image& image) {
    std::vector<std::uint8_t> bytes;
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            const raysteps::Rgb8& pixel = image.at(x, y);
            bytes.insert(bytes.end(), {pixel.r, pixel.g, pixel.b});
        }
    }
    show_tile(tile.x, tile.y, tile.width, tile.height, bytes.data());
}

}  // namespace

int main(int argc, char** argv) {
    const std::string_view program = argc > 0 ? argv[0] : "";
    if (program == "test") {
        return test_main(argc, argv);
    }
    if (program == "figure") {
        return raysteps::figure_main(argc, argv);
    }
    raysteps::set_tile_listener(tell_page);
    return raytrace_main(argc, argv);
}
