// Directions and paths: step 13.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "steps/13-path-tracing/path_tracing.hpp"
#include "worker/draws.hpp"
#include "worker/estimates.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"

namespace raysteps {
namespace {

void ask_cosine_direction(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 normal = words.vector();
    draw_often(words, [&](const glm::vec2& u) { answer.vector(cosine_direction(normal, u)); });
}

void ask_cosine_pdf(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 normal = words.vector();
    answer.number(cosine_pdf(normal, words.vector()));
}

void ask_scatter_diffuse(TokenReader& words, TokenWriter& answer) {
    const HitRecord hit = read_hit(words);
    draw_often(words, [&](const glm::vec2& u) {
        const std::optional<ScatterSample> sample = scatter_diffuse(hit, u);
        answer.whole(sample ? 1 : 0);
        if (sample) {
            answer.vector(sample->direction).vector(sample->weight).number(sample->pdf);
            answer.whole(sample->specular ? 1 : 0);
        }
    });
}

void ask_survival_probability(TokenReader& words, TokenWriter& answer) {
    answer.number(survival_probability(words.vector()));
}

/// What a path finds where its next ray goes.
struct ScriptedHit {
    float distance = 1.0F;
    glm::vec3 normal{0.0F};
    Color emission{0.0F};
    bool front_face = true;
    Color light{0.0F};                    ///< what light_sample gives
    std::optional<ScatterSample> sample;  ///< what scatter gives
};

struct Script {
    Color background{0.0F};
    bool goes_on = false;  ///< the last hit comes again and again
    std::vector<ScriptedHit> hits;
};

Script read_script(TokenReader& words) {
    Script script;
    script.background = words.vector();
    script.goes_on = words.flag();
    for (int left = words.count(); left > 0; --left) {
        ScriptedHit hit;
        hit.distance = words.number();
        hit.normal = words.vector();
        hit.emission = words.vector();
        hit.front_face = words.flag();
        hit.light = words.vector();
        if (words.flag()) {
            hit.sample.emplace();
            hit.sample->direction = words.vector();
            hit.sample->weight = words.vector();
            hit.sample->specular = words.flag();
        }
        script.hits.push_back(hit);
    }
    return script;
}

/// Answers from a script, and knows a hit by its distance, which differs from hit to hit.
class ScriptedPath final : public PathTracer {
public:
    explicit ScriptedPath(const Script& script) : script_(script) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        cast_.push_back(ray);
        const std::size_t number = cast_.size() - 1;
        if (script_.hits.empty() || cast_.size() > k_endless || (number >= script_.hits.size() && !script_.goes_on)) {
            return std::nullopt;
        }
        const ScriptedHit& scripted = script_.hits[std::min(number, script_.hits.size() - 1)];
        HitRecord hit;
        hit.position = ray.origin + scripted.distance * ray.direction;
        hit.normal = glm::dot(scripted.normal, ray.direction) <= 0.0F ? scripted.normal : -scripted.normal;
        hit.ray_direction = ray.direction;
        hit.distance = scripted.distance;
        hit.fill.emission = scripted.emission;
        hit.front_face = scripted.front_face;
        return hit;
    }

    [[nodiscard]] Color light_sample(const HitRecord& hit) override {
        ++asked_;
        return at(hit).light;
    }

    /// The direction is turned to the side of the normal. Who asks twice gets another one.
    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& hit) override {
        std::optional<ScatterSample> sample = at(hit).sample;
        if (sample) {
            const float along = glm::dot(sample->direction, hit.normal);
            sample->direction *= along < 0.0F ? -1.0F : 1.0F;
            if (++scattered_ > cast_.size()) {
                sample->direction = 2.0F * std::abs(along) * hit.normal - sample->direction;
            }
            sample->pdf = cosine_of(hit, *sample);
        }
        return sample;
    }

    [[nodiscard]] Color background() const override { return script_.background; }

    [[nodiscard]] const std::vector<Ray>& cast() const { return cast_; }
    [[nodiscard]] int cost() const { return static_cast<int>(cast_.size()) + asked_; }

private:
    static constexpr std::size_t k_endless = 300;  ///< rays, then there is nothing more to meet

    static float cosine_of(const HitRecord& hit, const ScatterSample& sample) {
        return glm::dot(hit.normal, sample.direction) / std::numbers::pi_v<float>;
    }

    [[nodiscard]] const ScriptedHit& at(const HitRecord& hit) const {
        static const ScriptedHit nothing;
        const auto found = std::ranges::find(script_.hits, hit.distance, &ScriptedHit::distance);
        return found == script_.hits.end() ? nothing : *found;
    }

    const Script& script_;
    mutable std::vector<Ray> cast_;
    int asked_ = 0;
    std::size_t scattered_ = 0;
};

/// Asked once, with all rays that were cast; or for estimates, where the plan wants some.
void ask_path_light(TokenReader& words, TokenWriter& answer) {
    const Ray ray = read_ray(words);
    const Script script = read_script(words);
    const EstimatePlan plan = read_estimate_plan(words);
    answer.word(plan.most > 0 ? "often" : "once");
    if (plan.most > 0) {
        write_estimates(plan, answer, [&](RandomStream& random) {
            ScriptedPath tracer(script);
            const Color light = path_light(tracer, ray, random);
            return Estimate{.value = light, .cost = tracer.cost()};
        });
        return;
    }
    RandomStream random(plan.seed);
    ScriptedPath tracer(script);
    answer.vector(path_light(tracer, ray, random));
    answer.whole(static_cast<long long>(tracer.cast().size()));
    for (const Ray& cast : tracer.cast()) {
        write_ray(answer, cast);
    }
}

}  // namespace

void add_paths(FunctionTable& functions) {
    functions["cosine_direction"] = ask_cosine_direction;
    functions["cosine_pdf"] = ask_cosine_pdf;
    functions["scatter_diffuse"] = ask_scatter_diffuse;
    functions["survival_probability"] = ask_survival_probability;
    functions["path_light"] = ask_path_light;
}

}  // namespace raysteps
