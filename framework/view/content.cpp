#include "view/content.hpp"

#include "render/cost_heatmap.hpp"
#include "render/encode.hpp"
#include "view/status_bar.hpp"

namespace raysteps {
namespace {

Image bar_for(int width, const Settings& settings, const std::string& status) {
    return settings.step.step >= 7 ? exposure_bar(width, status, settings.stops) : status_bar(width, status);
}

Image stacked(const Image& above, const Image& below) {
    Image both(above.width(), above.height() + below.height());
    for (int y = 0; y < both.height(); ++y) {
        for (int x = 0; x < both.width(); ++x) {
            both.at(x, y) = y < above.height() ? above.at(x, y) : below.at(x, y - above.height());
        }
    }
    return both;
}

}  // namespace

Image exposed(const Grid<Color>& colors, int step, float stops) {
    const float factor = step >= 7 ? exposure_factor(stops) : 1.0F;
    Image image(colors.width(), colors.height());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            image.at(x, y) = encode(factor * colors.at(x, y), step);
        }
    }
    return image;
}

Image content(const RenderedFrame& frame, const Settings& settings, const std::string& status) {
    if (settings.map) {
        return cost_heatmap(frame.costs, *settings.map, std::nullopt);
    }
    return stacked(exposed(frame.colors, settings.step.step, settings.stops),
                   bar_for(frame.colors.width(), settings, status));
}

Image without_status_bar(const Image& content, const Camera& camera) {
    Image picture(camera.width, camera.height);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            picture.at(x, y) = content.at(x, y);
        }
    }
    return picture;
}

int content_height(const Camera& camera) { return camera.height + legend_height(camera.width); }

}  // namespace raysteps
