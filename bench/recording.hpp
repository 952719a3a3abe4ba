#pragma once
// All questions that the renderer asks while it makes a picture, in their order.
#include <cstdint>
#include <vector>

#include "render/accelerator.hpp"
#include "render/ray_counter.hpp"

namespace raysteps::bench {

enum class Question : std::uint8_t { closest, any };

/// What a ray is counted as.
enum class CountedAs : std::uint8_t { eye, shadow, reflect, refract };

struct RecordedRay {
    Ray ray;
    float distance = 0.0F;  ///< question any: hits nearer than this count
    Question question = Question::closest;
    CountedAs kind = CountedAs::eye;
};

/// Writes down each ray before it is sent.
class Recorder final : public RayCounter {
public:
    Recorder(const Accelerator& scene, std::vector<RecordedRay>& rays)
        : RayCounter(scene), rays_(rays), shadow_rays_(RayCounter::shadow_query(k_no_ray, 0), rays) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const RayOrigin& origin, const Ray& ray) override;
    [[nodiscard]] bool occluded(const RayOrigin& origin, const Ray& ray, float distance) override;
    [[nodiscard]] const SceneQuery& shadow_query(RayNumber /*ray*/, std::size_t /*light*/) override {
        return shadow_rays_;
    }

private:
    class ShadowRays final : public SceneQuery {
    public:
        ShadowRays(const SceneQuery& inner, std::vector<RecordedRay>& rays) : inner_(inner), rays_(rays) {}
        [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
        [[nodiscard]] bool occluded(const Ray& ray, float distance) const override;

    private:
        const SceneQuery& inner_;
        std::vector<RecordedRay>& rays_;
    };

    std::vector<RecordedRay>& rays_;
    ShadowRays shadow_rays_;
};

/// Every n-th of the rays, from the first.
[[nodiscard]] std::vector<RecordedRay> every(std::size_t n, const std::vector<RecordedRay>& rays);

}  // namespace raysteps::bench
