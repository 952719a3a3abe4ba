// Step 05: a ray between two mirrors.
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/triangle.hpp"
#include "figure_list.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "steps/05-reflection/reflection.hpp"

namespace raysteps {
namespace {

constexpr int k_max_limit = 8;

/// Two mirrors that face each other, at x = -2 and x = 2, without ends. Each sends a light of 1 by itself.
class Mirrors final : public Tracer {
public:
    Mirrors(float ks, int limit)
        : limit_(limit),
          left_({-2.0F, -500.0F, -500.0F}, {-2.0F, 1000.0F, 0.0F}, {-2.0F, -500.0F, 500.0F}, {.ks = ks}),
          right_({2.0F, -500.0F, -500.0F}, {2.0F, 1000.0F, 0.0F}, {2.0F, -500.0F, 500.0F}, {.ks = ks}) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        const std::optional<HitRecord> hit = raysteps::closest_hit({&left_, &right_}, ray);
        if (hit) {
            path_.emplace_back(ray.origin, hit->position);
        }
        return hit;
    }

    [[nodiscard]] Color direct_lighting(const HitRecord& /*hit*/, int /*depth*/) override { return k_white; }
    [[nodiscard]] Color trace(const Ray& ray, int depth) override { return raysteps::trace(*this, ray, depth); }
    [[nodiscard]] int max_ray_depth() const override { return limit_; }
    [[nodiscard]] Color background() const override { return k_black; }

    /// Where each ray began and ended so far.
    [[nodiscard]] const std::vector<std::pair<glm::vec3, glm::vec3>>& path() const { return path_; }

private:
    int limit_;
    Triangle left_;
    Triangle right_;
    mutable std::vector<std::pair<glm::vec3, glm::vec3>> path_;
};

}  // namespace

/// The limit, ks, x and z of the eye, x and z of where it looks.
void mirrors_figure(Numbers numbers, JsonWriter& json) {
    const int limit = numbers.whole();
    const float ks = numbers.next();
    Ray ray;
    ray.origin.x = numbers.next();
    ray.origin.z = numbers.next();
    const float x = numbers.next();
    const glm::vec3 aim{x, 0.0F, numbers.next()};
    if (aim != ray.origin) {
        ray.direction = glm::normalize(aim - ray.origin);
    }
    json.key("sums").begin_array();  // with a limit of 1, 2 and so on
    for (int other = 1; other <= k_max_limit; ++other) {
        Mirrors mirrors(ks, other);
        json.number(mirrors.trace(ray, 1).r);
    }
    json.end_array();
    Mirrors mirrors(ks, limit);
    json.key("sum").number(mirrors.trace(ray, 1).r);
    json.key("path").begin_array();
    for (const auto& [from, to] : mirrors.path()) {
        json.begin_array().vector(from).vector(to).end_array();
    }
    json.end_array();
}

}  // namespace raysteps
