#include "render/film_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "core/random_stream.hpp"
#include "render/pixel_samples.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/10-sampling/sampling.hpp"
#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {
namespace {

constexpr int k_fine = 256;          // places along each side of a pixel
constexpr int k_max_rounds = 16;     // of samples in one pixel
constexpr std::size_t k_least = 16;  // samples, before they say how far they are off
constexpr float k_dark = 0.1F;

float reach_of(Filter filter) {
    switch (filter) {
        case Filter::box:
            return 0.5F;
        case Filter::tent:
            return 1.0F;
        case Filter::mitchell:
            return 2.0F;
    }
    return 0.5F;
}

/// Pixels around a tile whose samples reach into it.
int margin_of(Filter filter) { return static_cast<int>(std::ceil(reach_of(filter) - 0.5F)); }

/// Also of a point outside of the unit square, as a wrong step may give: within the picture of `size` pixels, which
/// shows it.
int fine_place(int pixel, float point, int size) {
    const float near = std::isfinite(point) ? glm::clamp(point, -8.0F, 8.0F) : 0.5F;
    return std::clamp(pixel * k_fine + static_cast<int>(std::floor(near * k_fine)), 0, size - 1);
}

/// From the middle of the pixel to the middle of the finer pixel.
float offset_of(int fine, int pixel) {
    return (static_cast<float>(fine - pixel * k_fine) + 0.5F) / static_cast<float>(k_fine) - 0.5F;
}

/// What leaves on one side comes back on the other.
glm::vec2 shifted(const glm::vec2& point, const glm::vec2& shift) {
    const glm::vec2 moved = point + shift;
    return moved - glm::step(glm::vec2(1.0F), moved);
}

/// With so many pixels around it, as far as there is a picture: beyond it step 01 promises nothing.
Rect grown(const Rect& tile, int margin, const Camera& fine_camera) {
    const int left = std::max(tile.x - margin, 0);
    const int top = std::max(tile.y - margin, 0);
    const int right = std::min(tile.x + tile.width + margin, fine_camera.width / k_fine);
    const int bottom = std::min(tile.y + tile.height + margin, fine_camera.height / k_fine);
    return {.x = left, .y = top, .width = right - left, .height = bottom - top};
}

/// From the middle of the pixel, no farther than the filter reaches.
std::vector<PixelSample> samples_near(const FilmSampler::Film& film, int x, int y, const Rect& around, float reach) {
    std::vector<PixelSample> found;
    for (int row = around.y; row < around.y + around.height; ++row) {
        for (int column = around.x; column < around.x + around.width; ++column) {
            for (const FilmSampler::FilmSample& sample : film.pixels[film.place_of(column, row)]) {
                const glm::vec2 offset(offset_of(sample.x, x), offset_of(sample.y, y));
                if (std::max(std::abs(offset.x), std::abs(offset.y)) <= reach) {
                    found.push_back({.offset = offset, .light = sample.light});
                }
            }
        }
    }
    return found;
}

}  // namespace

FilmSampler::FilmSampler(const Camera& camera, int side, const SamplingOptions& options)
    : side_(side), options_(options), fine_camera_(finer(camera, k_fine)), frame_(view_frame(fine_camera_)) {
    const int points = side * side * (options.max_error > 0.0F ? k_max_rounds : 1);
    for (int index = 0; options.sampler == Sampler::halton && index < points; ++index) {
        halton_points_.push_back(halton_point(static_cast<std::uint32_t>(index)));
    }
}

std::vector<glm::vec2> FilmSampler::points_of_round(int round, const glm::vec2& shift, RandomStream& random) const {
    if (options_.sampler == Sampler::stratified) {
        return stratified_samples(side_, random);
    }
    std::vector<glm::vec2> points;
    const std::size_t count = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
    for (const glm::vec2& point : std::span(halton_points_).subspan(static_cast<std::size_t>(round) * count, count)) {
        points.push_back(shifted(point, shift));
    }
    return points;
}

std::vector<FilmSampler::FilmSample> FilmSampler::samples_of(int x, int y, Integrator& integrator) const {
    std::vector<FilmSample> samples;
    SampleId sample = first_sample(x, y);
    RandomStream random(options_.seed, pixel_number(x, y));
    const glm::vec2 shift = shift_of(random);
    for (int round = 0; round == 0 || (round < k_max_rounds && !is_good_enough(samples)); ++round) {
        for (const glm::vec2& point : points_of_round(round, shift, random)) {
            const Primary next = primary(x, y, point, sample);
            samples.push_back({.x = next.x, .y = next.y, .light = integrator.primary_color(next.ray, sample)});
            ++sample.index;
        }
    }
    return samples;
}

SampleId FilmSampler::first_sample(int x, int y) const {
    return {.pixel = RandomStream::philox({pixel_number(x, y), options_.seed, 0, 0}, {0, 0})[0]};
}

glm::vec2 FilmSampler::shift_of(RandomStream& random) const {
    return options_.sampler == Sampler::halton ? random.next_2d() : glm::vec2(0.0F);
}

FilmSampler::Primary FilmSampler::primary(int x, int y, const glm::vec2& point, const SampleId& sample) const {
    const int fine_x = fine_place(x, point.x, fine_camera_.width);
    const int fine_y = fine_place(y, point.y, fine_camera_.height);
    const Ray ray = through_lens(primary_ray(fine_camera_, frame_, fine_x, fine_y), sample);
    return {.ray = ray, .sample = sample, .x = fine_x, .y = fine_y};
}

FilmSampler::Primary FilmSampler::halton_sample(int x, int y, std::uint32_t index) const {
    RandomStream random(options_.seed, pixel_number(x, y));
    SampleId sample = first_sample(x, y);
    sample.index = index;
    return primary(x, y, shifted(halton_points_.at(index), shift_of(random)), sample);
}

bool FilmSampler::is_good_enough(const std::vector<FilmSample>& samples) const {
    if (options_.max_error == 0.0F) {
        return true;
    }
    const PixelEstimate estimate = estimate_of(samples);
    const auto brightness = [](const Color& color) { return glm::dot(color, Color(1.0F / 3.0F)); };
    const float error = std::sqrt(brightness(estimate.variance)) / std::max(brightness(estimate.mean), k_dark);
    return samples.size() >= k_least && error <= options_.max_error;
}

/// The integrator's streams count up from 0; the lens has the last one.
Ray FilmSampler::through_lens(const Ray& ray, const SampleId& sample) const {
    constexpr std::uint32_t k_last_stream = 65535;
    return fine_camera_.lens_radius > 0.0F ? lens_ray(fine_camera_, frame_, ray, sample.stream(k_last_stream).next_2d())
                                           : ray;
}

PixelEstimate FilmSampler::estimate_of(const std::vector<FilmSample>& samples) {
    const auto count = static_cast<float>(samples.size());
    PixelEstimate estimate;
    for (const FilmSample& sample : samples) {
        estimate.mean += sample.light / count;
    }
    for (const FilmSample& sample : samples) {
        const Color off = sample.light - estimate.mean;
        estimate.variance += off * off / (count * std::max(count - 1.0F, 1.0F));
    }
    return estimate;
}

FilmSampler::Film FilmSampler::empty_film(const Rect& tile) const {
    const Rect area = grown(tile, margin_of(options_.filter), fine_camera_);
    const std::size_t count = static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height);
    return {.area = area, .pixels = std::vector<std::vector<FilmSample>>(count)};
}

void FilmSampler::sample_pixel(Film& film, int x, int y, Integrator& integrator) const {
    film.pixels[film.place_of(x, y)] = samples_of(x, y, integrator);
}

FilmSampler::Film FilmSampler::sampled_film(const Rect& tile, Integrator& integrator) const {
    Film film = empty_film(tile);
    for (int y = film.area.y; y < film.area.y + film.area.height; ++y) {
        for (int x = film.area.x; x < film.area.x + film.area.width; ++x) {
            sample_pixel(film, x, y, integrator);
        }
    }
    return film;
}

FilmSampler::Pixel FilmSampler::pixel_of(const Film& film, int x, int y) const {
    const Rect around = grown({.x = x, .y = y, .width = 1, .height = 1}, margin_of(options_.filter), fine_camera_);
    const std::vector<PixelSample> near = samples_near(film, x, y, around, reach_of(options_.filter));
    return {.color = reconstruct(near, options_.filter), .estimate = estimate_of(film.pixels[film.place_of(x, y)])};
}

}  // namespace raysteps
