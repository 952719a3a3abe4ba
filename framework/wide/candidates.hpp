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
            ask_certain();
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

    /// Whether there is one sure hit, and nobody has been asked: mostly so.
    [[nodiscard]] bool has_one() const { return count_ == 1 && !best_; }

    /// The nearest hit of all: of one, without any copy of its record, and of any number.
    [[nodiscard]] std::optional<HitRecord> ask_one() const { return sure_.front().surface->hit(ray_); }
    [[nodiscard]] const std::optional<HitRecord>& ask_all() {
        ask_certain();
        return best_;
    }

    /// Whether a surface that should have been hit surely was not: the bound was too narrow for this ray.
    [[nodiscard]] bool failed(const std::optional<HitRecord>& nearest) const {
        const bool too_far = limit_ < (nearest ? nearest->distance : std::numeric_limits<float>::max());
        return failed_ || too_far;
    }

private:
    void ask_certain() {
        for (std::size_t i = 0; i < count_; ++i) {
            if (sure_[i].least <= limit_) {
                const bool hit = ask(*sure_[i].surface);
                failed_ = failed_ || !hit;
            }
        }
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
