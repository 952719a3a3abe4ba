#include "worker/protocol.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>

#include "io/numbers.hpp"

namespace raysteps {

std::string TokenReader::word() {
    const std::size_t start = rest_.find_first_not_of(' ');
    if (start == std::string_view::npos) {
        throw ProtocolError("the case ends too early");
    }
    rest_.remove_prefix(start);
    const std::string found(rest_.substr(0, rest_.find(' ')));
    rest_.remove_prefix(found.size());
    return found;
}

// strtof and not from_chars, which some standard libraries lack for float.
float TokenReader::number() {
    const std::string text = word();
    char* end = nullptr;
    const float value = std::strtof(text.c_str(), &end);
    if (end != text.c_str() + text.size()) {
        throw ProtocolError("expected a number, found " + text);
    }
    return value;
}

int TokenReader::whole() {
    const std::string text = word();
    char* end = nullptr;
    const long value = std::strtol(text.c_str(), &end, 10);
    if (end != text.c_str() + text.size() || value < -1000000000L || value > 1000000000L) {
        throw ProtocolError("expected a whole number, found " + text);
    }
    return static_cast<int>(value);
}

std::uint32_t TokenReader::index() {
    const std::string text = word();
    char* end = nullptr;
    const long long value = std::strtoll(text.c_str(), &end, 10);
    constexpr long long k_max_index = std::numeric_limits<std::uint32_t>::max();
    if (end != text.c_str() + text.size() || value < 0 || value > k_max_index) {
        throw ProtocolError("expected an index, found " + text);
    }
    return static_cast<std::uint32_t>(value);
}

int TokenReader::count() {
    const int value = whole();
    if (value < 0 || value > 1000000) {
        throw ProtocolError("expected a count, found " + std::to_string(value));
    }
    return value;
}

glm::vec3 TokenReader::vector() {
    const float x = number();
    const float y = number();
    const float z = number();
    return {x, y, z};
}

void TokenReader::expect_end() {
    if (rest_.find_first_not_of(' ') != std::string_view::npos) {
        throw ProtocolError("the case is too long");
    }
}

TokenWriter& TokenWriter::word(std::string_view word) {
    text_ += ' ';
    text_ += word;
    return *this;
}

TokenWriter& TokenWriter::number(float value) { return word(number_text(value)); }

TokenWriter& TokenWriter::whole(long long value) { return word(std::to_string(value)); }

TokenWriter& TokenWriter::vector(const glm::vec3& value) { return number(value.x).number(value.y).number(value.z); }

Ray read_ray(TokenReader& words) {
    Ray ray;
    ray.origin = words.vector();
    ray.direction = words.vector();
    return ray;
}

Camera read_camera(TokenReader& words) {
    Camera camera;
    camera.from = words.vector();
    camera.at = words.vector();
    camera.up = words.vector();
    camera.angle = words.number();
    camera.width = words.whole();
    camera.height = words.whole();
    camera.hither = words.number();
    camera.lens_radius = words.number();
    camera.focal_distance = words.number();
    return camera;
}

ViewFrame read_frame(TokenReader& words) {
    ViewFrame frame;
    frame.right = words.vector();
    frame.up = words.vector();
    frame.forward = words.vector();
    frame.half_width = words.number();
    frame.half_height = words.number();
    return frame;
}

Fill read_fill(TokenReader& words) {
    Fill fill;
    fill.color = words.vector();
    fill.kd = words.number();
    fill.ks = words.number();
    fill.shine = words.number();
    fill.transmittance = words.number();
    fill.index_of_refraction = words.number();
    return fill;
}

Light read_light(TokenReader& words) {
    Light light;
    light.position = words.vector();
    light.color = words.vector();
    return light;
}

HitRecord read_hit(TokenReader& words) {
    HitRecord hit;
    hit.position = words.vector();
    hit.fill = read_fill(words);
    hit.normal = words.vector();
    hit.ray_direction = words.vector();
    hit.distance = words.number();
    hit.front_face = words.flag();
    return hit;
}

Box read_box(TokenReader& words) {
    Box box;
    box.min = words.vector();
    box.max = words.vector();
    return box;
}

std::vector<Light> read_lights(TokenReader& words) {
    std::vector<Light> lights;
    for (int left = words.count(); left > 0; --left) {
        lights.push_back(read_light(words));
    }
    return lights;
}

void write_ray(TokenWriter& answer, const Ray& ray) { answer.vector(ray.origin).vector(ray.direction); }

void write_frame(TokenWriter& answer, const ViewFrame& frame) {
    answer.vector(frame.right).vector(frame.up).vector(frame.forward);
    answer.number(frame.half_width).number(frame.half_height);
}

void write_hit(TokenWriter& answer, const std::optional<HitRecord>& hit) {
    if (!hit) {
        answer.word("miss");
        return;
    }
    answer.word("hit").vector(hit->position);
    const Fill& fill = hit->fill;
    answer.vector(fill.color).number(fill.kd).number(fill.ks).number(fill.shine);
    answer.number(fill.transmittance).number(fill.index_of_refraction);
    answer.vector(hit->normal).vector(hit->ray_direction).number(hit->distance).flag(hit->front_face);
}

void write_box(TokenWriter& answer, const Box& box) { answer.vector(box.min).vector(box.max); }

}  // namespace raysteps
