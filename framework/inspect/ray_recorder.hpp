#pragma once
// A RayCounter that writes down what it hears. It computes nothing of its own, so that the pixel stays the same.
#include "core/scene.hpp"
#include "inspect/ray_tree.hpp"
#include "inspect/search_recorder.hpp"

namespace raysteps {

class RayRecorder final : public RayCounter {
public:
    /// Writes rays and counts into the record, whose options must be set. For one pixel.
    RayRecorder(const Scene& scene, const Accelerator& accelerator, PixelRecord& record);

    [[nodiscard]] std::optional<HitRecord> closest_hit(const RayOrigin& origin, const Ray& ray) override;
    [[nodiscard]] bool occluded(const RayOrigin& origin, const Ray& ray, float distance) override;
    [[nodiscard]] const SceneQuery& shadow_query(RayNumber ray, std::size_t light) override;
    void light_answered(RayNumber ray, bool lit) override;
    void area_light_sampled(RayNumber ray, std::size_t light, const LightSample& sample,
                            const Color& unshadowed) override;
    void area_light_handed_on(RayNumber ray, const DirectSample& sample) override;
    [[nodiscard]] RayNumber ray_of_hit(const HitRecord& hit, RayNumber first, RayNumber last) const override {
        return tree_.ray_of_hit(hit, first, last);
    }
    void shaded(RayNumber ray, const HitRecord& hit, const Color& local,
                const std::optional<Color>& transmitted) override;
    void lamps_sampled(RayNumber ray, const Color& light) override;
    void scattered(RayNumber ray, const std::optional<ScatterSample>& sample) override;
    void arrived(RayNumber first, RayNumber last, const Color& color) override { tree_.arrived(first, last, color); }

    /// Writes down what all rays cost together.
    void finish();

private:
    /// What step 04 asks at the hit of a ray.
    class ShadowQuery final : public SceneQuery {
    public:
        explicit ShadowQuery(RayRecorder& recorder) : recorder_(recorder) {}

        /// The light is null where nothing of it is kept.
        void begin(RayNumber of, ShadowRecord* light, const SceneQuery& scene) {
            of_ = of;
            light_ = light;
            scene_ = &scene;
        }
        [[nodiscard]] ShadowRecord* light() const { return light_; }

        [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
        [[nodiscard]] bool occluded(const Ray& ray, float distance) const override;

    private:
        RayRecorder& recorder_;
        RayNumber of_ = k_no_ray;
        ShadowRecord* light_ = nullptr;
        const SceneQuery* scene_ = nullptr;
    };

    [[nodiscard]] std::optional<HitRecord> search(RayNode* node, const SceneQuery& scene, const Ray& ray);
    [[nodiscard]] bool search_any(RayNode* node, const SceneQuery& scene, const Ray& ray, float distance);
    [[nodiscard]] ShadowRecord* light_at(RayNumber ray, std::size_t light);
    void describe_hit_of(RayNode& node, const HitRecord& hit, const Surface* surface) const;
    void check(RayNode& node, float limit);
    [[nodiscard]] PathStep* path_step(RayNumber ray);

    const Scene& scene_;
    const Accelerator& accelerator_;
    PixelRecord& record_;
    SearchRecorder search_;
    RayTree tree_;
    ShadowQuery shadow_query_;
    std::uint64_t checks_left_;
    LampRecord* lamp_ = nullptr;  // that was sampled last; null: it is not kept
};

}  // namespace raysteps
