#pragma once
// A StepTracer that writes down what it does. It computes nothing of its own, so that the pixel stays the same.
#include <exception>
#include <list>
#include <vector>

#include "inspect/recorder.hpp"
#include "inspect/replay.hpp"

namespace raysteps {

/// Thrown through a step that follows rays far beyond the greatest depth, before it runs out of stack.
class EndlessRays : public std::exception {
public:
    [[nodiscard]] const char* what() const noexcept override { return "the rays never end"; }
};

class RecordingTracer final : public StepTracer {
public:
    /// Writes rays and counts into the record, whose options must be set.
    RecordingTracer(const Scene& scene, const Accelerator& accelerator, PixelRecord& record);

    /// The colour of the pixel before tone mapping; nothing where the rays never end.
    [[nodiscard]] std::optional<Color> follow(const Ray& ray);

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) override;
    [[nodiscard]] bool any_hit(const Ray& ray, float distance) override;
    [[nodiscard]] Color local_light(const HitRecord& hit, int depth) override;
    [[nodiscard]] Color trace(const Ray& ray, int depth) override;

    [[nodiscard]] const Recorder& recorder() const { return recorder_; }

protected:
    [[nodiscard]] bool reaches(const HitRecord& hit, const Light& light) override;

private:
    /// One call of trace: the rays that step 05 casts in it, one after the other.
    struct Frame {
        std::size_t first_ray = 0;  // in rays_
        int depth = 1;
        CastRay* parent = nullptr;
        bool through_glass = false;
    };

    [[nodiscard]] CastRay& open(const Ray& ray);
    void open_node(CastRay& cast, CastRay* parent, RayRole role);
    [[nodiscard]] CastRay* parent_of(const Ray& ray);
    [[nodiscard]] RayNode* open_shadow_ray(const Ray& ray, std::optional<float> limit);
    [[nodiscard]] std::optional<HitRecord> search(RayNode* node, const Ray& ray);
    void meet(RayNode& node, const HitRecord& hit, const Surface* surface);
    void check(RayNode& node, float limit);
    void describe_light(const HitRecord& hit, CastRay& cast, int depth);
    void close(const Frame& frame, const Color& color);

    const Scene& scene_;
    const Accelerator& accelerator_;
    PixelRecord& record_;
    Recorder recorder_;
    std::list<CastRay> casts_;     // all rays but shadow rays, for as long as their frame is open
    std::vector<CastRay*> rays_;   // the same, by number
    std::vector<Frame> frames_;
    CastRay* shading_ = nullptr;   // whose local_light is at work
    LightRecord* light_ = nullptr; // the light that is_lit is asked about
    bool in_is_lit_ = false;
    std::uint64_t kept_rays_ = 0;
    std::uint64_t checks_left_;
};

}  // namespace raysteps
