#pragma once
// The rays of a pixel by their numbers, and where in the record each is written down.
#include <exception>
#include <vector>

#include "inspect/pixel_record.hpp"

namespace raysteps {

/// How many rays of a pixel are kept. What goes beyond is counted all the same.
inline constexpr std::uint64_t k_max_rays = 1024;
inline constexpr int k_max_levels = 32;  ///< rays that follow from one another

/// Thrown through a step that follows rays far beyond the greatest depth, before it runs out of stack.
class EndlessRays : public std::exception {
public:
    [[nodiscard]] const char* what() const noexcept override { return "the rays never end"; }
};

class RayTree {
public:
    explicit RayTree(PixelRecord& record) : record_(record) {}

    /// Gives the next ray its number, and its place with the ray that it comes from. Null where there is no room.
    /// Throws EndlessRays.
    [[nodiscard]] RayNode* open(const RayOrigin& origin, const Ray& ray);

    /// The next ray has a number and no place.
    void leave_out();

    /// The place is with a light at the hit of that ray; null: there is none.
    [[nodiscard]] RayNode* open_shadow_ray(RayNumber of, ShadowRecord* light, const Ray& ray);

    /// Null where the ray is not kept.
    [[nodiscard]] RayNode* node(RayNumber ray) const { return ray < rays_.size() ? rays_[ray].node : nullptr; }

    /// See RayCounter.
    [[nodiscard]] RayNumber ray_of_hit(const HitRecord& hit, RayNumber first, RayNumber last) const;
    void arrived(RayNumber first, RayNumber last, const Color& color);

    [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

private:
    struct Sent {
        RayNode* node = nullptr;
        RayNumber from = k_no_ray;
        int level = 0;  ///< rays that it follows from
    };

    [[nodiscard]] RayNode* place(const RayOrigin& origin, const Ray& ray, int level);
    [[nodiscard]] RayNode* kept(RayNode* node, const Ray& ray);

    PixelRecord& record_;
    std::vector<Sent> rays_;
    std::uint64_t kept_ = 0;
    std::uint64_t left_out_ = 0;
};

}  // namespace raysteps
