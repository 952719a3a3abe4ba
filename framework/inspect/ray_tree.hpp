#pragma once
// Which ray follows from which. Step 05 calls itself, so that has to be found out from the rays.
#include <exception>
#include <list>
#include <span>
#include <vector>

#include "inspect/recorder.hpp"
#include "inspect/replay.hpp"

namespace raysteps {

/// Thrown through a step that follows rays far beyond the greatest depth, before it runs out of stack.
class EndlessRays : public std::exception {
public:
    [[nodiscard]] const char* what() const noexcept override { return "the rays never end"; }
};

/// Makes a node for each ray, as long as there is room in the record.
class RayTree {
public:
    RayTree(PixelRecord& record, Recorder& recorder) : record_(record), recorder_(recorder) {}

    /// A call of trace begins: its first ray follows from `parent`, the others each from one before it in the call.
    void begin_call(int depth, CastRay* parent, bool through_glass);
    void end_call();

    /// The rays of the call, in the order of casting.
    [[nodiscard]] std::span<CastRay* const> rays_of_call() const;
    [[nodiscard]] CastRay* last_of_call() const;

    /// Throws EndlessRays.
    [[nodiscard]] CastRay& open(const Ray& ray);

    /// Null where there is no room.
    [[nodiscard]] RayNode* open_shadow_ray(LightRecord* light, int depth, const Ray& ray, std::optional<float> limit);

    /// The ray of the call that gave this hit; the last one where none did; null where there is none.
    [[nodiscard]] CastRay* ray_of_hit(const HitRecord& hit) const;

private:
    struct Call {
        std::size_t first_ray = 0;  // in rays_
        int depth = 1;
        CastRay* parent = nullptr;
        bool through_glass = false;
    };

    [[nodiscard]] CastRay* parent_of(const Ray& ray) const;
    void add_node(CastRay& cast, CastRay* parent, RayRole role);

    PixelRecord& record_;
    Recorder& recorder_;
    std::list<CastRay> casts_;    // all rays but shadow rays, for as long as their call lasts
    std::vector<CastRay*> rays_;  // the same, by number
    std::vector<Call> calls_;
    std::uint64_t kept_ = 0;
};

}  // namespace raysteps
