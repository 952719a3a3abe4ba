// Lamps with a size and a lens: step 12. What is random is asked many times.
#include <array>
#include <utility>

#include "core/random_stream.hpp"
#include "core/threads.hpp"
#include "steps/12-soft-light/soft_light.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"

namespace raysteps {
namespace {

/// Seed and number: points of the unit square; without a seed its corners and what lies between them, where divisions
/// by 0 hide. The first one comes once more at the end.
std::vector<glm::vec2> read_points(TokenReader& words) {
    const auto seed = static_cast<std::uint32_t>(words.whole());
    const int times = words.count();
    constexpr std::array<float, 4> k_corners{0.0F, 0.25F, 0.5F, 1.0F - 1.0F / 16777216.0F};
    RandomStream random(seed);
    std::vector<glm::vec2> points;
    for (std::size_t i = 0; std::cmp_less(i, times); ++i) {
        points.push_back(seed == 0 ? glm::vec2(k_corners.at(i % 4), k_corners.at(i / 4 % 4)) : random.next_2d());
    }
    points.push_back(points.empty() ? glm::vec2(0.0F) : points.front());
    return points;
}

void write_samples(TokenWriter& answer, const std::vector<LightSample>& samples) {
    for (const LightSample& sample : samples) {
        answer.vector(sample.position).vector(sample.normal).number(sample.pdf);
    }
}

// The vector, then what becomes of x, y and z.
void ask_turned_to(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 normal = words.vector();
    answer.vector(turned_to(normal, words.vector()));
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 along(0.0F);
        along[axis] = 1.0F;
        answer.vector(turned_to(normal, along));
    }
}

void ask_unit_disk(TokenReader& words, TokenWriter& answer) {
    for (const glm::vec2& place : answers_to(read_points(words), unit_disk)) {
        answer.number(place.x).number(place.y);
    }
}

void ask_cap_direction(TokenReader& words, TokenWriter& answer) {
    const float height = words.number();
    const auto ask = [&](const glm::vec2& u) { return cap_direction(height, u); };
    for (const glm::vec3& direction : answers_to(read_points(words), ask)) {
        answer.vector(direction);
    }
}

void ask_solid_angle_pdf(TokenReader& words, TokenWriter& answer) {
    const float area_pdf = words.number();
    const glm::vec3 from = words.vector();
    const glm::vec3 position = words.vector();
    answer.number(solid_angle_pdf(area_pdf, from, position, words.vector()));
}

void ask_sample_triangle(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 a = words.vector();
    const glm::vec3 b = words.vector();
    const TriangleLight light{a, b, words.vector()};
    const glm::vec3 from = words.vector();
    write_samples(answer,
                  answers_to(read_points(words), [&](const glm::vec2& u) { return sample_triangle(light, from, u); }));
}

void ask_sample_disk(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 center = words.vector();
    const glm::vec3 normal = words.vector();
    const DiskLight light{center, normal, words.number()};
    const glm::vec3 from = words.vector();
    write_samples(answer,
                  answers_to(read_points(words), [&](const glm::vec2& u) { return sample_disk(light, from, u); }));
}

void ask_sample_sphere(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 center = words.vector();
    const SphereLight light{center, words.number()};
    const glm::vec3 from = words.vector();
    write_samples(answer,
                  answers_to(read_points(words), [&](const glm::vec2& u) { return sample_sphere(light, from, u); }));
}

void ask_sampled_light(TokenReader& words, TokenWriter& answer) {
    const HitRecord hit = read_hit(words);
    const Color radiance = words.vector();
    const glm::vec3 position = words.vector();
    const glm::vec3 normal = words.vector();
    answer.vector(sampled_light(hit, radiance, {position, normal, words.number()}));
}

void ask_lens_ray(TokenReader& words, TokenWriter& answer) {
    const ViewFrame frame = read_frame(words);
    const Ray ray = read_ray(words);
    Camera camera;
    camera.from = ray.origin;
    camera.lens_radius = words.number();
    camera.focal_distance = words.number();
    const auto ask = [&](const glm::vec2& u) { return lens_ray(camera, frame, ray, u); };
    for (const Ray& one : answers_to(read_points(words), ask)) {
        write_ray(answer, one);
    }
}

}  // namespace

void add_soft_light(FunctionTable& functions) {
    functions["turned_to"] = ask_turned_to;
    functions["unit_disk"] = ask_unit_disk;
    functions["cap_direction"] = ask_cap_direction;
    functions["solid_angle_pdf"] = ask_solid_angle_pdf;
    functions["sample_triangle"] = ask_sample_triangle;
    functions["sample_disk"] = ask_sample_disk;
    functions["sample_sphere"] = ask_sample_sphere;
    functions["sampled_light"] = ask_sampled_light;
    functions["lens_ray"] = ask_lens_ray;
}

}  // namespace raysteps
