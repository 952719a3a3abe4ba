// The direction around z is turned to the normal by a matrix; small functions, one for each part of the path.
#include "steps/13-path-tracing/path_tracing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>

namespace raysteps {
namespace {

/// Its third column is the normal.
glm::mat3 frame_around(const glm::vec3& normal) {
    const glm::vec3 size = glm::abs(normal);
    glm::vec3 least(0.0F);
    least[size.x <= size.y && size.x <= size.z ? 0 : (size.y <= size.z ? 1 : 2)] = 1.0F;
    const glm::vec3 first = glm::normalize(glm::cross(least, normal));
    return {first, glm::cross(normal, first), normal};
}

class Path {
public:
    Path(PathTracer& tracer, const Ray& ray, RandomStream& random) : tracer_(tracer), next_(ray), random_(random) {}

    Color follow() {
        while (step()) {
            ++bounces_;
        }
        return light_;
    }

private:
    bool step() {
        const std::optional<HitRecord> hit = tracer_.closest_hit(next_);
        if (!hit) {
            find(tracer_.background());
            return false;
        }
        if (sees_lamps_) {
            find(emitted_light(*hit));
        }
        find(tracer_.light_sample(*hit));
        return bounce(*hit);
    }

    void find(const Color& found) { light_ += weight_ * found; }

    bool bounce(const HitRecord& hit) {
        const std::optional<ScatterSample> sample = tracer_.scatter(hit);
        if (!sample) {
            return false;
        }
        weight_ *= sample->weight;
        next_ = scattered_ray(hit, *sample);
        sees_lamps_ = sample->specular;
        return bounces_ < k_sure_bounces || survives();
    }

    bool survives() {
        const float chance = survival_probability(weight_);
        const bool lives = chance > random_.next();
        weight_ /= lives ? chance : 1.0F;
        return lives;
    }

    PathTracer& tracer_;
    Ray next_;
    RandomStream& random_;
    Color light_ = k_black;
    Color weight_ = k_white;
    int bounces_ = 0;
    bool sees_lamps_ = true;
};

}  // namespace

glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    const float cosine = std::sqrt(1.0F - u.y);
    const float sine = std::sqrt(u.y);
    const float turn = glm::two_pi<float>() * u.x;
    return frame_around(normal) * glm::vec3(sine * std::sin(turn), sine * std::cos(turn), cosine);
}

float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) {
    return glm::max(glm::dot(direction, normal), 0.0F) / glm::pi<float>();
}

std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    const Color share = hit.fill.color * hit.fill.kd;
    if (share.r + share.g + share.b == 0.0F) {
        return std::nullopt;
    }
    const glm::vec3 towards = cosine_direction(hit.normal, u);
    return ScatterSample{.direction = towards, .weight = share, .pdf = cosine_pdf(hit.normal, towards)};
}

float survival_probability(const Color& weight) {
    return glm::clamp(glm::max(weight.r, glm::max(weight.g, weight.b)), 0.0F, k_max_survival);
}

Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    return Path(tracer, ray, random).follow();
}

}  // namespace raysteps
