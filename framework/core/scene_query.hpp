#pragma once
// What does this ray meet? The one interface for that question: the structures answer it, and what counts, records or
// stands in for them is wrapped around it.
#include <cstdint>
#include <optional>

#include "core/hit_record.hpp"
#include "core/ray.hpp"

namespace raysteps {

/// Safe to ask from many threads at once, unless a class says otherwise.
class SceneQuery {
public:
    virtual ~SceneQuery() = default;

    /// The nearest hit with distance > 0 among all surfaces, or nothing.
    [[nodiscard]] virtual std::optional<HitRecord> closest_hit(const Ray& ray) const = 0;

    /// Whether any surface is hit nearer than `distance`: all that a shadow ray wants to know. Costs no more than
    /// closest_hit, and less where the first hit that is found ends the search.
    [[nodiscard]] virtual bool occluded(const Ray& ray, float distance) const {
        const std::optional<HitRecord> hit = closest_hit(ray);
        return hit && hit->distance < distance;
    }

protected:
    SceneQuery() = default;
    SceneQuery(const SceneQuery&) = default;
    SceneQuery& operator=(const SceneQuery&) = default;
};

/// Passes both questions on, and counts them where its owner says. Each thread has its own.
class CountingQuery final : public SceneQuery {
public:
    CountingQuery(const SceneQuery& inner, std::uint64_t& rays) : inner_(inner), rays_(rays) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        ++rays_;
        return inner_.closest_hit(ray);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        ++rays_;
        return inner_.occluded(ray, distance);
    }

private:
    const SceneQuery& inner_;
    std::uint64_t& rays_;
};

}  // namespace raysteps
