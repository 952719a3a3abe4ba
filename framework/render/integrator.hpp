#pragma once
// One small integrator per stage of the course: from a primary ray to a colour, with what there is so far.
#include <cstdint>
#include <memory>

#include "core/random_stream.hpp"
#include "core/scene.hpp"
#include "render/accelerator.hpp"
#include "render/ray_counter.hpp"

namespace raysteps {

/// What step 02 shows of a hit.
enum class View { color, normals };

struct StepOptions {
    int step = 8;  ///< from 1 on; 9 shows what 8 shows, a later one what it makes of that
    View view = View::color;
    int max_ray_depth = 5;
};

/// Part two, light by chance: a pixel's samples are those of step 10, and so is the curve that they are shown by. An
/// instructor's own steps, from 20 on, go on from step 09.
[[nodiscard]] constexpr bool is_of_part_two(int step) { return step >= 10 && step < 20; }

/// From step 12 on lamps may have a size, and so may the camera's lens.
[[nodiscard]] constexpr bool has_area_lights(int step) { return is_of_part_two(step) && step >= 12; }

/// From step 13 on light comes along paths.
[[nodiscard]] constexpr bool follows_paths(int step) { return is_of_part_two(step) && step >= 13; }

/// Which sample of a picture a primary ray is: its random numbers hang on nothing else.
struct SampleId {
    std::uint32_t pixel = 0;  ///< another number for each pixel of each picture
    std::uint32_t index = 0;  ///< among the samples of the pixel, below 65536

    /// Of its streams, one that is independent of all others. Numbers from 65536 on, of scenes with as many lamps, are
    /// those of another pixel, far away in the odd steps of the golden ratio.
    [[nodiscard]] RandomStream stream(std::uint32_t number) const {
        return RandomStream(pixel + (number >> 16U) * 0x9E3779B9U, (index << 16U) + (number & 0xFFFFU));
    }
};

[[nodiscard]] constexpr std::uint32_t pixel_number(int x, int y) {
    return (static_cast<std::uint32_t>(y) << 16U) ^ static_cast<std::uint32_t>(x);
}

/// Calls the step functions. Each thread has its own.
class Integrator {
public:
    /// Both must outlive it.
    Integrator(const Scene& scene, RayCounter& rays) : scene_(scene), rays_(rays) {}
    virtual ~Integrator() = default;
    Integrator(const Integrator&) = delete;
    Integrator& operator=(const Integrator&) = delete;

    /// The colour of a primary ray, before tone mapping.
    [[nodiscard]] Color primary_color(const Ray& ray, const SampleId& sample = {}) {
        rays_.begin_pixel();
        sample_ = sample;
        streams_ = 0;
        return color_of(ray);
    }

    /// How deep the last primary ray and what came of it went, see RayCounter.
    [[nodiscard]] int deepest_ray() const { return rays_.deepest(); }

protected:
    [[nodiscard]] virtual Color color_of(const Ray& ray) = 0;

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] RayCounter& rays() { return rays_; }

    /// Random numbers for one call of a step's function: a fresh stream each time, so that what the call takes of it
    /// changes no other.
    [[nodiscard]] RandomStream next_stream() { return sample_.stream(streams_++); }

private:
    const Scene& scene_;
    RayCounter& rays_;
    SampleId sample_;
    std::uint32_t streams_ = 0;
};

/// The one that shows what the step gives.
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(const Scene& scene, RayCounter& rays,
                                                          const StepOptions& options);

}  // namespace raysteps
