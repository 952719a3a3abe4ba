#pragma once
// Part two: the samples of all pixels, drawn, followed and put together by step 10.
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/camera.hpp"
#include "core/image.hpp"
#include "core/pixel_sample.hpp"
#include "render/integrator.hpp"
#include "render/rect.hpp"

namespace raysteps {

/// Where samples come from. Halton's points are the same for all pixels, moved by an own random shift in each; what
/// leaves on one side comes back on the other (Cranley and Patterson 1976).
enum class Sampler { halton, stratified };

struct SamplingOptions {
    Sampler sampler = Sampler::halton;
    Filter filter = Filter::tent;
    std::uint32_t seed = 10;  ///< of all random numbers
    /// More samples for a pixel, up to 16 times as many, until its brightness is known to this share of itself, or of
    /// 0.1 where it is darker; 0: no more. Which pixels go on hangs on what they saw, which makes the picture a little
    /// darker than it should be (Kirk and Arvo 1991).
    float max_error = 0.0F;
};

/// What a pixel's own samples say of its light, before filter and curve. The variance is that of the mean, as if the
/// samples were independent.
struct PixelEstimate {
    Color mean{0.0F};
    Color variance{0.0F};
};

using EstimateGrid = Grid<PixelEstimate>;

/// Before step 12 the camera has no lens.
[[nodiscard]] inline Camera camera_of_step(Camera camera, int step) {
    camera.lens_radius = has_area_lights(step) ? camera.lens_radius : 0.0F;
    return camera;
}

/// Shared by all threads. The samples of a pixel depend on nothing but its place: so the picture is the same however it
/// is cut into tiles, though those around a tile are followed again for its neighbour.
class FilmSampler {
public:
    /// side * side samples in each pixel, each through another point of the camera's lens.
    FilmSampler(const Camera& camera, int side, const SamplingOptions& options);

    struct Pixel {
        Color color;  ///< from all samples within the filter's reach
        PixelEstimate estimate;
    };

    /// A sample before it is followed.
    struct Primary {
        Ray ray;
        SampleId sample;
        int x;  ///< of the finer picture
        int y;
    };

    /// That sample of a pixel, from 0 on, as `sample_pixel` follows it; of Halton's points only, below side * side.
    [[nodiscard]] Primary halton_sample(int x, int y, std::uint32_t index) const;

    struct FilmSample {
        int x;  ///< of the finer picture
        int y;
        Color light;
    };

    /// The samples of all pixels of an area, row by row.
    struct Film {
        Rect area;
        std::vector<std::vector<FilmSample>> pixels;

        [[nodiscard]] std::size_t place_of(int x, int y) const {
            return static_cast<std::size_t>((y - area.y) * area.width + x - area.x);
        }
    };

    /// Of a tile and the pixels around it whose samples reach into it, still without samples.
    [[nodiscard]] Film empty_film(const Rect& tile) const;
    /// Follows the samples of one pixel of the film; others may be sampled at the same time.
    void sample_pixel(Film& film, int x, int y, Integrator& integrator) const;
    /// The film of a tile with all samples.
    [[nodiscard]] Film sampled_film(const Rect& tile, Integrator& integrator) const;

    /// One of the tile's pixels, from a film with all samples.
    [[nodiscard]] Pixel pixel_of(const Film& film, int x, int y) const;

private:
    [[nodiscard]] std::vector<FilmSample> samples_of(int x, int y, Integrator& integrator) const;
    [[nodiscard]] SampleId first_sample(int x, int y) const;
    [[nodiscard]] glm::vec2 shift_of(RandomStream& random) const;
    [[nodiscard]] Primary primary(int x, int y, const glm::vec2& point, const SampleId& sample) const;
    [[nodiscard]] Ray through_lens(const Ray& ray, const SampleId& sample) const;
    [[nodiscard]] static PixelEstimate estimate_of(const std::vector<FilmSample>& samples);
    [[nodiscard]] bool is_good_enough(const std::vector<FilmSample>& samples) const;
    [[nodiscard]] std::vector<glm::vec2> points_of_round(int round, const glm::vec2& shift, RandomStream& random) const;

    int side_;
    SamplingOptions options_;
    Camera fine_camera_;  ///< a sample is a pixel of a finer picture, as step 01 aims at the middle of a pixel
    ViewFrame frame_;
    std::vector<glm::vec2> halton_points_;
};

}  // namespace raysteps
