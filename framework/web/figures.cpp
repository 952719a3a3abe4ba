// The live figures of the handouts: the reader's numbers go to the functions of the steps, what these say comes back as
// JSON. Nothing is computed here that a step computes.
#include "figures.hpp"

#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <span>

#include "io/command_line.hpp"
#include "io/json_writer.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps {
namespace {

constexpr int k_samples = 81;  // of a curve

/// What the page sends, one after the other.
class Numbers {
public:
    explicit Numbers(std::span<char*> words) : words_(words) {}

    [[nodiscard]] float next() {
        const float value = words_.empty() ? 0.0F : std::strtof(words_.front(), nullptr);
        words_ = words_.subspan(words_.empty() ? 0 : 1);
        return value;
    }

    [[nodiscard]] int whole() { return static_cast<int>(next()); }

private:
    std::span<char*> words_;
};

/// angle, how far `up` leans, width, height, x, y: the camera of the worked example of step 01.
void camera(Numbers numbers, JsonWriter& json) {
    Camera camera;
    camera.angle = numbers.next();
    const float leaning = glm::radians(numbers.next());
    camera.up = {glm::sin(leaning), glm::cos(leaning), 0.0F};
    camera.width = numbers.whole();
    camera.height = numbers.whole();
    const int x = numbers.whole();
    const int y = numbers.whole();
    const ViewFrame frame = view_frame(camera);
    json.key("from").vector(camera.from).key("forward").vector(frame.forward);
    json.key("right").vector(frame.right).key("up").vector(frame.up);
    json.key("halfWidth").number(frame.half_width).key("halfHeight").number(frame.half_height);
    json.key("direction").vector(primary_ray(camera, frame, x, y).direction);
    json.key("directions").begin_array();
    for (int row = 0; row < camera.height; ++row) {
        for (int column = 0; column < camera.width; ++column) {
            json.vector(primary_ray(camera, frame, column, row).direction);
        }
    }
    json.end_array();
}

/// y of the plane in which the ray runs, x and z of where it starts, x and z of where it is aimed at.
void meet(const Surface& surface, Numbers numbers, JsonWriter& json) {
    const float y = numbers.next();
    Ray ray;
    ray.origin.x = numbers.next();
    ray.origin.y = y;
    ray.origin.z = numbers.next();
    const float x = numbers.next();
    const glm::vec3 aim{x, y, numbers.next()};
    if (aim != ray.origin) {
        ray.direction = glm::normalize(aim - ray.origin);
    }
    json.key("direction").vector(ray.direction);
    const std::optional<HitRecord> hit = surface.hit(ray);
    json.key("hit");
    if (!hit) {
        json.null();
        return;
    }
    json.begin_object();
    json.key("distance").number(hit->distance).key("position").vector(hit->position);
    json.key("normal").vector(hit->normal).key("front").flag(hit->front_face);
    json.end_object();
}

void bytes(const Color& color, JsonWriter& json) {
    json.begin_array();
    for (const float channel : {color.r, color.g, color.b}) {
        json.whole(to_byte(channel));
    }
    json.end_array();
}

/// The greatest light of the curve, the exposure, and the light of red, green and blue before it.
void tone(Numbers numbers, JsonWriter& json) {
    const float most = numbers.next();
    const float exposure = numbers.next();
    Color light;
    light.r = exposure * numbers.next();
    light.g = exposure * numbers.next();
    light.b = exposure * numbers.next();
    const Color shown = tone_map(light);
    json.key("light").vector(light).key("shown").vector(shown);
    json.key("bytes");
    bytes(shown, json);
    json.key("cutOff");
    bytes(light, json);
    json.key("curve").begin_array();
    for (int sample = 0; sample < k_samples; ++sample) {
        const float at = most * static_cast<float>(sample) / static_cast<float>(k_samples - 1);
        json.number(tone_map(Color(exposure * at)).r);
    }
    json.end_array();
}

bool answer(std::string_view name, Numbers numbers, JsonWriter& json) {
    if (name == "camera") {
        camera(numbers, json);
    } else if (name == "sphere") {
        meet(Sphere({1.0F, 2.0F, 3.0F}, 5.0F, {}), numbers, json);
    } else if (name == "triangle") {
        meet(Triangle({0.0F, 0.0F, 0.0F}, {4.0F, 0.0F, 0.0F}, {0.0F, 4.0F, 0.0F}, {}), numbers, json);
    } else if (name == "tone") {
        tone(numbers, json);
    } else {
        return false;
    }
    return true;
}

}  // namespace

int figure_main(int argc, char** argv) {
    const std::span<char*> words(argv, static_cast<std::size_t>(argc));
    return run_program("play", [&words] {
        JsonWriter json;
        json.begin_object();
        if (words.size() < 2 || !answer(words[1], Numbers(words.subspan(2)), json)) {
            throw UsageError("expected the name of a figure");
        }
        json.end_object();
        std::printf("\n%s\n", json.result().c_str());  // in a line of its own, whatever the student prints
    });
}

}  // namespace raysteps
