#pragma once
// From a scene to a picture: tiles, threads, counters.
#include <optional>

#include "core/image.hpp"
#include "core/scene.hpp"
#include "core/stats.hpp"
#include "render/film_sampler.hpp"
#include "render/pixel_cost.hpp"
#include "render/rect.hpp"

namespace raysteps {

struct RenderOptions {
    StepOptions step;
    Acceleration acceleration = Acceleration::none;
    int threads = 1;
    std::optional<Rect> crop;    ///< inside the picture; nothing: the whole picture
    bool show_progress = false;  ///< a bar on stderr
    bool measure_cost = false;   ///< fills Rendering::costs, which takes some time; needs a sample_side of 1
    int sample_side = 1;         ///< each pixel is the mean of the light of sample_side * sample_side rays
    SamplingOptions sampling{};  ///< which rays, and which mean; of part two only
};

struct Rendering {
    Image image;
    Stats stats;
    AcceleratorStats structure;
    double build_seconds = 0.0;
    double render_seconds = 0.0;
    CostGrid costs;          ///< as large as the image, or empty
    EstimateGrid estimates;  ///< of part two only, else empty
};

/// The same bytes for any number of threads.
[[nodiscard]] Rendering render(const Scene& scene, const RenderOptions& options);

/// Who wants to see pictures grow is told of each part that is drawn, from one thread at a time.
using TileListener = void (*)(const Rect& tile, const Image& image);
void set_tile_listener(TileListener listener);

}  // namespace raysteps
