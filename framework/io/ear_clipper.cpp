#include "io/ear_clipper.hpp"

#include <glm/common.hpp>
#include <utility>

#include "io/point_grid.hpp"

namespace raysteps {
namespace {

using Point = glm::dvec2;
using Indices = std::array<std::size_t, 3>;

// Corners and cells looked at before a polygon is given up: a second or two.
constexpr std::size_t k_most_work = 400'000'000;

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
    std::size_t waits;  // the round in which it lost a neighbour
};

double turn(std::span<const Point> points, const Corner& corner, std::size_t i) {
    return area(points[corner.before], points[i], points[corner.after]);
}

std::vector<Corner> ring(std::span<const Point> points) {
    const std::size_t count = points.size();
    std::vector<Corner> corners;
    corners.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        corners.push_back({(i + count - 1) % count, (i + 1) % count, 0.0, true, 0});
        corners.back().turn = turn(points, corners.back(), i);
    }
    return corners;
}

std::vector<std::size_t> dents_of(const std::vector<Corner>& corners) {
    std::vector<std::size_t> dents;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i].turn <= 0.0) {
            dents.push_back(i);
        }
    }
    return dents;
}

class EarClipper {
public:
    explicit EarClipper(std::span<const Point> points)
        : points_(points), corners_(ring(points)), left_(points.size()), dents_(points, dents_of(corners_)) {}

    std::optional<std::vector<Indices>> run() {
        std::size_t left_at_refill = left_ + 1;
        while (left_ > 3 && work_ < k_most_work) {
            if (!next_.empty()) {
                run_round();
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
    // A corner whose neighbour was cut waits for the next round, or one corner would become the tip of a long fan.
    void run_round() {
        ++round_;
        const std::vector<std::size_t> now = std::exchange(next_, {});
        for (const std::size_t i : now) {
            if (left_ > 3 && work_ < k_most_work && corners_[i].left && corners_[i].waits != round_ && is_ear(i)) {
                cut(i);
            }
        }
    }

    void measure(std::size_t i) { corners_[i].turn = turn(points_, corners_[i], i); }

    // Only dents can lie in an ear. Convex corners that lie in it come with a dent that does.
    bool is_ear(std::size_t i) {
        if (corners_[i].turn <= 0.0) {
            return corners_[i].turn == 0.0;
        }
        const std::size_t before = corners_[i].before;
        const std::size_t after = corners_[i].after;
        const Point low = glm::min(points_[i], glm::min(points_[before], points_[after]));
        const Point high = glm::max(points_[i], glm::max(points_[before], points_[after]));
        return !dents_.any_in(low, high, work_, [&](std::size_t dent) { return blocks(dent, before, i, after); });
    }

    // A corner at the same place as one of the ear's does not block it: holes are joined by such pairs.
    bool blocks(std::size_t dent, std::size_t a, std::size_t b, std::size_t c) const {
        const Point& p = points_[dent];
        const bool is_dent = corners_[dent].left && corners_[dent].turn <= 0.0;
        if (!is_dent || p == points_[a] || p == points_[b] || p == points_[c]) {
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
        for (const std::size_t neighbour : {before, after}) {
            measure(neighbour);
            if (corners_[neighbour].waits != round_) {
                corners_[neighbour].waits = round_;
                next_.push_back(neighbour);
            }
        }
    }

    void queue_all() {
        std::size_t i = any_left();
        for (std::size_t count = 0; count < left_; ++count, i = corners_[i].after) {
            ++work_;
            next_.push_back(i);
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
    PointGrid dents_;
    std::vector<std::size_t> next_;  // corners that the next round looks at
    std::size_t round_ = 0;
    std::size_t work_ = 0;
    std::vector<Indices> triangles_;
};

}  // namespace

std::optional<std::vector<Indices>> clip_ears(std::span<const glm::dvec2> polygon) { return EarClipper(polygon).run(); }

}  // namespace raysteps
