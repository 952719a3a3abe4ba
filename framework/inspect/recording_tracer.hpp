#pragma once
// A StepTracer that writes down what it does. It computes nothing of its own, so that the pixel stays the same.
#include "inspect/ray_tree.hpp"

namespace raysteps {

class RecordingTracer final : public StepTracer {
public:
    /// Writes rays and counts into the record, whose options must be set.
    RecordingTracer(const Scene& scene, const Accelerator& accelerator, PixelRecord& record);

    /// The colour of the pixel before tone mapping; nothing where the rays never end.
    [[nodiscard]] std::optional<Color> follow(const Ray& ray);

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
    [[nodiscard]] bool any_hit(const Ray& ray, float distance) const override;
    [[nodiscard]] Color local_light(const HitRecord& hit, int depth) override;
    [[nodiscard]] Color trace(const Ray& ray, int depth) override;

protected:
    [[nodiscard]] bool reaches(const HitRecord& hit, const Light& light) override;

private:
    [[nodiscard]] RayNode* open_shadow_ray(const Ray& ray, std::optional<float> limit) const;
    [[nodiscard]] std::optional<HitRecord> search(RayNode* node, const Ray& ray) const;
    void meet(RayNode& node, const HitRecord& hit, const Surface* surface) const;
    void check(RayNode& node, float limit) const;
    void describe(const HitRecord& hit, CastRay& cast, int depth);
    void color_rays(const Color& color);

    const Scene& scene_;
    const Accelerator& accelerator_;
    PixelRecord& record_;
    mutable Recorder recorder_;
    mutable RayTree tree_;
    CastRay* shading_ = nullptr;    // whose local_light is at work
    LightRecord* light_ = nullptr;  // the light that is_lit is asked about, where it is kept
    bool in_is_lit_ = false;
    mutable std::uint64_t checks_left_;
};

}  // namespace raysteps
