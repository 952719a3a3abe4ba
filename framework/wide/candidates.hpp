#pragma once
// The nearest hit so far: what is known of it exactly, and which surfaces may beat it.
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/hit_record.hpp"
#include "wide/tree.hpp"

namespace raysteps::wide {

/// A stretch of the ray in which a surface is surely hit.
struct CertainHit {
    const Surface* surface;
    float least;
    float most;
};

class Candidates {
public:
    explicit Candidates(const Ray& ray) : ray_(ray) {}

    /// No hit beyond this distance can be the nearest.
    [[nodiscard]] float limit() const { return limit_; }

    /// To be asked at the end, if nothing surely nearer turns up.
    void add(const CertainHit& sure) {
        if (sure.least > limit_) {
            return;
        }
        if (count_ == sure_.size()) {
            ask_all();
        }
        sure_[count_++] = sure;
        limit_ = sure.most < limit_ ? sure.most : limit_;
    }

    /// Asks a surface that may be hit or not. Returns whether it was.
    bool ask(const Surface& surface) {
        const std::optional<HitRecord> hit = surface.hit(ray_);
        if (!hit) {
            return false;
        }
        const bool nearer = !best_ || hit->distance < best_->distance;
        if (nearer || (hit->distance == best_->distance && surface.order() < order_)) {
            best_ = hit;
            order_ = surface.order();
            limit_ = hit->distance < limit_ ? hit->distance : limit_;
        }
        return true;
    }

    /// The nearest hit of all.
    [[nodiscard]] const std::optional<HitRecord>& settle() {
        ask_all();
        return best_;
    }

    /// Whether a surface that should have been hit surely was not: the bound was too narrow for this ray.
    [[nodiscard]] bool failed() const { return failed_; }

private:
    void ask_all() {
        for (std::size_t i = 0; i < count_; ++i) {
            if (sure_[i].least <= limit_) {
                const bool hit = ask(*sure_[i].surface);
                failed_ = failed_ || !hit;
            }
        }
        failed_ = failed_ || (count_ > 0 && best_ && best_->distance > limit_);
        count_ = 0;
    }

    const Ray& ray_;
    std::array<CertainHit, 12> sure_;  // the first count_ of them
    std::size_t count_ = 0;
    std::optional<HitRecord> best_;
    std::size_t order_ = 0;
    float limit_ = std::numeric_limits<float>::max();
    bool failed_ = false;
};

}  // namespace raysteps::wide
