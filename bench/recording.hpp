#pragma once
// All questions that the renderer asks while it makes a picture, in their order.
#include <cstdint>
#include <vector>

#include "core/stats.hpp"
#include "render/accelerator.hpp"

namespace raysteps::bench {

enum class Question : std::uint8_t { closest, any };
enum class RayKind : std::uint8_t { eye, shadow, reflect, refract };

struct RecordedRay {
    Ray ray;
    float distance = 0.0F;  ///< question any: hits nearer than this count
    Question question = Question::closest;
    RayKind kind = RayKind::eye;
};

/// Passes every question on, and writes it down.
class Recorder final : public Accelerator {
public:
    /// known: what the thread had counted when the last ray was asked.
    Recorder(const Accelerator& inner, std::vector<RecordedRay>& rays, Stats& known)
        : inner_(inner), rays_(rays), known_(known) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override;

    /// To be called after the last ray.
    void finish() const { name_last(); }

private:
    void name_last() const;

    const Accelerator& inner_;
    std::vector<RecordedRay>& rays_;
    Stats& known_;
};

/// Every n-th of the rays, from the first.
[[nodiscard]] std::vector<RecordedRay> every(std::size_t n, const std::vector<RecordedRay>& rays);

}  // namespace raysteps::bench
