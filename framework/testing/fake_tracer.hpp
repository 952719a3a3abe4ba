#pragma once
// Stand-ins for the renderer: they answer from a function or a list. Their occluded is SceneQuery's own, by way of
// closest_hit: it gives the same answer, and whoever remembers rays hears of it as of any other.
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/tracer.hpp"

namespace raysteps::testing {

/// Answers closest_hit from a function, for example [&](const Ray& ray) { return sphere.hit(ray); }.
class FakeScene final : public SceneQuery {
public:
    using Answer = std::function<std::optional<HitRecord>(const Ray&)>;

    FakeScene() = default;  ///< an empty scene
    explicit FakeScene(Answer answer) : answer_(std::move(answer)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return answer_ ? answer_(ray) : std::nullopt;
    }

private:
    Answer answer_;
};

/// A renderer whose every answer the test chooses, and that remembers what it was asked. Unset answers: no hit, black.
class FakeTracer final : public Tracer {
public:
    struct Asked {
        Ray ray;
        int depth;
    };
    struct Shaded {
        HitRecord hit;
        int depth;
    };

    /// The hits that closest_hit gives one after the other; a miss when they are used up.
    void answer_in_order(std::vector<HitRecord> hits) {
        on_closest_hit = [list = std::move(hits), next = std::size_t{0}](const Ray&) mutable {
            return next < list.size() ? std::optional<HitRecord>(list[next++]) : std::nullopt;
        };
    }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        cast.push_back(ray);
        return on_closest_hit ? on_closest_hit(ray) : std::nullopt;
    }

    [[nodiscard]] Color direct_lighting(const HitRecord& hit, int depth) override {
        shaded.push_back({hit, depth});
        return on_direct_lighting ? on_direct_lighting(hit, depth) : k_black;
    }

    [[nodiscard]] Color trace(const Ray& ray, int depth) override {
        traced.push_back({ray, depth});
        return on_trace ? on_trace(ray, depth) : k_black;
    }

    [[nodiscard]] int max_ray_depth() const override { return max_depth; }
    [[nodiscard]] Color background() const override { return background_color; }

    std::function<std::optional<HitRecord>(const Ray&)> on_closest_hit;
    std::function<Color(const HitRecord&, int)> on_direct_lighting;
    std::function<Color(const Ray&, int)> on_trace;
    int max_depth = 5;
    Color background_color = k_black;

    mutable std::vector<Ray> cast;  ///< rays given to closest_hit or occluded
    std::vector<Asked> traced;      ///< rays given to trace
    std::vector<Shaded> shaded;     ///< hits given to direct_lighting
};

}  // namespace raysteps::testing
