#pragma once
// What a path finds, from a script: steps 13 and 15.
#include <optional>
#include <vector>

#include "core/mis_tracer.hpp"
#include "core/random_stream.hpp"
#include "worker/estimates.hpp"
#include "worker/protocol.hpp"

namespace raysteps {

/// A lamp that is seen from a plate in all directions whose cosine with the plate's normal lies between the two: equal
/// solid angles are equally likely for its samples.
struct ScriptedLamp {
    float low = 0.0F;
    float high = 1.0F;
    Color radiance{0.0F};

    [[nodiscard]] float pdf() const;
};

/// What a path finds where its next ray goes.
struct ScriptedPathHit {
    float distance = 1.0F;
    glm::vec3 normal{0.0F};
    Color emission{0.0F};
    bool front_face = true;
    Color light{0.0F};                    ///< what light_sample gives
    std::optional<ScatterSample> sample;  ///< what scatter gives; a pdf of 0: that of a matt surface

    // of step 15
    float light_pdf = 0.0F;
    std::vector<DirectSample> samples;
    float exponent = 0.0F;  ///< above 0: a plate, which scatters by the cosine to that power, and whose lamps are these
    std::vector<ScriptedLamp> lamps;
};

struct PathScript {
    Color background{0.0F};
    bool goes_on = false;  ///< the last hit comes again and again
    std::vector<ScriptedPathHit> hits;
};

[[nodiscard]] ScatterSample read_scatter(TokenReader& words);  ///< direction, weight, specular
/// How many, then light, pdf and scatter pdf of each.
[[nodiscard]] std::vector<DirectSample> read_samples(TokenReader& words);

/// Of step 13, or with what step 15 asks besides.
[[nodiscard]] PathScript read_path_script(TokenReader& words);
[[nodiscard]] PathScript read_mis_script(TokenReader& words);

/// Answers from a script, and knows a hit by its distance, which differs from hit to hit. Its own random numbers are
/// those of plates.
class ScriptedPath final : public MisTracer {
public:
    explicit ScriptedPath(const PathScript& script, const RandomStream& random = {})
        : script_(script), random_(random) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
    [[nodiscard]] Color light_sample(const HitRecord& hit) override;
    [[nodiscard]] std::vector<DirectSample> direct_samples(const HitRecord& hit) override;
    [[nodiscard]] float light_pdf(const glm::vec3& from, const HitRecord& hit) const override;
    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& hit) override;
    [[nodiscard]] Color background() const override { return script_.background; }

    [[nodiscard]] const std::vector<Ray>& cast() const { return cast_; }
    [[nodiscard]] int cost() const { return static_cast<int>(cast_.size()) + asked_; }

private:
    [[nodiscard]] const ScriptedPathHit& at(const HitRecord& hit) const;
    [[nodiscard]] std::vector<DirectSample> samples_at(const HitRecord& hit);

    const PathScript& script_;
    RandomStream random_;
    mutable std::vector<Ray> cast_;
    mutable std::vector<HitRecord> met_;  ///< of the script
    int asked_ = 0;
    std::size_t scattered_ = 0;
};

/// Asked once, with all rays that were cast; or for estimates, where the plan wants some. light(tracer, random) asks
/// the step.
template <typename Light>
void answer_path(const PathScript& script, const EstimatePlan& plan, TokenWriter& answer, const Light& light) {
    answer.word(plan.most > 0 ? "often" : "once");
    if (plan.most > 0) {
        write_estimates(plan, answer, [&](RandomStream& random) {
            RandomStream same = random;  // of which the step gets all numbers
            const auto number = [&] { return static_cast<std::uint32_t>(same.next() * 16777216.0F); };
            const std::uint32_t seed = number();
            ScriptedPath tracer(script, RandomStream(seed, number()));
            const Color found = light(tracer, random);
            return Estimate{.value = found, .cost = tracer.cost()};
        });
        return;
    }
    RandomStream random(plan.seed);
    ScriptedPath tracer(script);
    answer.vector(light(tracer, random));
    answer.whole(static_cast<long long>(tracer.cast().size()));
    for (const Ray& cast : tracer.cast()) {
        write_ray(answer, cast);
    }
}

}  // namespace raysteps
