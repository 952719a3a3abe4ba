#include "io/ear_clipper.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>

namespace raysteps {
namespace {

using Point = glm::dvec2;
using Indices = std::array<std::size_t, 3>;

// Corners looked at before a polygon is given up: a second or two.
constexpr std::int64_t k_most_work = 400'000'000;

// Twice the area of the triangle, above 0 where a, b, c run counter-clockwise.
double area(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside(const Point& p, const Point& a, const Point& b, const Point& c) {
    return area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
}

// A corner in the ring of those that are left.
struct Corner {
    std::size_t before;
    std::size_t after;
    double turn;  // the area of the corner's triangle: above 0 convex, below 0 a dent
    bool left;
};

class EarClipper {
public:
    explicit EarClipper(std::span<const Point> points) : points_(points), corners_(points.size()), left_(points.size()) {
        const std::size_t count = points.size();
        for (std::size_t i = 0; i < count; ++i) {
            corners_[i] = {(i + count - 1) % count, (i + 1) % count, 0.0, true};
            measure(i);
        }
        choose_sorting_axis();
        for (std::size_t i = 0; i < count; ++i) {
            if (corners_[i].turn <= 0.0) {
                dents_.push_back(i);
            }
        }
        std::sort(dents_.begin(), dents_.end(), [this](std::size_t a, std::size_t b) { return key(a) < key(b); });
    }

    std::optional<std::vector<Indices>> run() {
        queue_all();
        std::size_t left_at_refill = left_;
        while (left_ > 3 && work_ < k_most_work) {
            if (!queue_.empty()) {
                const std::size_t i = queue_.front();
                queue_.pop_front();
                if (corners_[i].left && is_ear(i)) {
                    cut(i);
                }
            } else if (left_ < left_at_refill) {
                left_at_refill = left_;
                queue_all();
            } else {
                cut(least_bad());  // only where the polygon touches or crosses itself
            }
        }
        if (left_ > 3) {
            return std::nullopt;
        }
        cut(corners_[any_left()].after);  // the middle one, so that a triangle stays as it came
        return std::move(triangles_);
    }

private:
    void measure(std::size_t i) {
        corners_[i].turn = area(points_[corners_[i].before], points_[i], points_[corners_[i].after]);
    }

    // Dents are sorted along the polygon's longer side: an ear then looks at those within its own stretch only.
    void choose_sorting_axis() {
        Point low(std::numeric_limits<double>::infinity());
        Point high = -low;
        for (const Point& p : points_) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        axis_ = high.x - low.x >= high.y - low.y ? 0 : 1;
    }

    double key(std::size_t i) const { return points_[i][axis_]; }

    // Only dents can lie in an ear. Convex corners that lie in it come with a dent that does.
    bool is_ear(std::size_t i) {
        if (corners_[i].turn <= 0.0) {
            return corners_[i].turn == 0.0;
        }
        const std::size_t before = corners_[i].before;
        const std::size_t after = corners_[i].after;
        const double from = std::min({key(before), key(i), key(after)});
        const double to = std::max({key(before), key(i), key(after)});
        auto dent = std::lower_bound(dents_.begin(), dents_.end(), from,
                                     [this](std::size_t d, double value) { return key(d) < value; });
        for (; dent != dents_.end() && key(*dent) <= to; ++dent) {
            ++work_;
            if (blocks(*dent, before, i, after)) {
                return false;
            }
        }
        return true;
    }

    // A corner at the same place as one of the ear's does not block it: holes are joined by such pairs.
    bool blocks(std::size_t dent, std::size_t a, std::size_t b, std::size_t c) const {
        const Point& p = points_[dent];
        if (!corners_[dent].left || corners_[dent].turn > 0.0 || p == points_[a] || p == points_[b] || p == points_[c]) {
            return false;
        }
        return inside(p, points_[a], points_[b], points_[c]);
    }

    void cut(std::size_t i) {
        const std::size_t before = corners_[i].before;
        const std::size_t after = corners_[i].after;
        if (corners_[i].turn != 0.0) {
            triangles_.push_back({before, i, after});
        }
        corners_[i].left = false;
        --left_;
        corners_[before].after = after;
        corners_[after].before = before;
        start_ = after;
        measure(before);
        measure(after);
        queue_.push_back(before);
        queue_.push_back(after);
    }

    void queue_all() {
        std::size_t i = any_left();
        for (std::size_t count = 0; count < left_; ++count, i = corners_[i].after) {
            ++work_;
            queue_.push_back(i);
        }
    }

    std::size_t least_bad() {
        std::size_t best = any_left();
        std::size_t i = best;
        for (std::size_t count = 0; count < left_; ++count, i = corners_[i].after) {
            ++work_;
            if (corners_[i].turn > 0.0) {
                return i;
            }
        }
        return best;
    }

    std::size_t any_left() const { return start_; }

    std::span<const Point> points_;
    std::vector<Corner> corners_;
    std::size_t left_;
    std::size_t start_ = 0;
    int axis_ = 0;
    std::vector<std::size_t> dents_;
    std::deque<std::size_t> queue_;
    std::int64_t work_ = 0;
    std::vector<Indices> triangles_;
};

}  // namespace

std::optional<std::vector<Indices>> clip_ears(std::span<const glm::dvec2> polygon) { return EarClipper(polygon).run(); }

}  // namespace raysteps
