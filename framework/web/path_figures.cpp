// Step 13: directions by the cosine, and paths that end by chance.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "figure_list.hpp"
#include "figure_numbers.hpp"
#include "steps/13-path-tracing/path_tracing.hpp"

namespace raysteps {
namespace {

constexpr int k_directions = 200;
constexpr int k_paths = 500;
constexpr int k_shown = 4;     // of so many paths the mean is drawn
constexpr int k_longest = 24;  // of those that are counted one by one

/// The surface of the worked example.
HitRecord worked_hit(const glm::vec3& normal) {
    HitRecord hit;
    hit.fill = {.color = {0.9F, 0.5F, 0.1F}, .kd = 0.8F};
    hit.normal = normal;
    hit.ray_direction = -normal;
    return hit;
}

/// Surfaces without end: each adds a light of 1, and sends on the same share of what comes.
class Furnace final : public PathTracer {
public:
    explicit Furnace(float share) : share_(share) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& /*ray*/) const override {
        ++hits_;
        HitRecord hit;
        hit.normal = {0.0F, 1.0F, 0.0F};
        hit.ray_direction = {0.0F, -1.0F, 0.0F};
        hit.distance = 1.0F;
        return hit;
    }

    [[nodiscard]] Color light_sample(const HitRecord& /*hit*/) override { return k_white; }
    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& hit) override {
        return ScatterSample{hit.normal, Color(share_), 1.0F, false};
    }
    [[nodiscard]] Color background() const override { return k_black; }

    [[nodiscard]] int hits() const { return hits_; }

private:
    float share_;
    mutable int hits_ = 0;
};

}  // namespace

/// By how many degrees the normal leans, and the two numbers that a direction is made of.
void cosine_figure(Numbers numbers, JsonWriter& json) {
    const float lean = glm::radians(numbers.next());
    const float x = numbers.next();
    const glm::vec2 u{x, numbers.next()};
    const glm::vec3 normal{glm::sin(lean), glm::cos(lean), 0.0F};
    const glm::vec3 direction = cosine_direction(normal, u);
    json.key("normal").vector(normal).key("direction").vector(direction);
    json.key("height").number(glm::dot(direction, normal)).key("pdf").number(cosine_pdf(normal, direction));
    const std::optional<ScatterSample> sample = scatter_diffuse(worked_hit(normal), u);
    json.key("weight").vector(sample ? sample->weight : k_black);
    json.key("lobe").begin_array();  // the density of each direction in the plane, from straight up to the right
    for (int degree = 0; degree <= 360; degree += 3) {
        const float angle = glm::radians(static_cast<float>(degree));
        const glm::vec3 towards{glm::sin(angle), glm::cos(angle), 0.0F};
        const float density = cosine_pdf(normal, towards);
        write_drawn(json, {density * towards.x, density * towards.y});
    }
    json.end_array();
    RandomStream random(1);
    json.key("others").begin_array();
    for (int at = 0; at < k_directions; ++at) {
        const glm::vec2 other = random.next_2d();
        const glm::vec3 found = cosine_direction(normal, other);
        write_drawn(json, {other.x, other.y, found.x, found.y, found.z});
    }
    json.end_array();
}

/// The share that each surface sends on.
void roulette_figure(Numbers numbers, JsonWriter& json) {
    const float share = numbers.next();
    std::vector<std::uint64_t> lengths(k_longest, 0);
    RandomStream random(1);
    float sum = 0.0F;
    int longest = 0;
    json.key("means").begin_array();  // of so many paths
    for (int path = 1; path <= k_paths; ++path) {
        Furnace furnace(share);
        sum += path_light(furnace, {}, random).r;
        if (path % k_shown == 0) {
            write_drawn(json, {static_cast<float>(path), sum / static_cast<float>(path)});
        }
        longest = std::max(longest, furnace.hits());
        ++lengths[static_cast<std::size_t>(std::clamp(furnace.hits(), 1, k_longest) - 1)];
    }
    json.end_array();
    json.key("mean").number(sum / static_cast<float>(k_paths)).key("survival");
    json.number(survival_probability(Color(share)));
    json.key("longest").whole(static_cast<std::uint64_t>(longest)).key("lengths").begin_array();
    for (const std::uint64_t count : lengths) {
        json.whole(count);
    }
    json.end_array();
}

}  // namespace raysteps
