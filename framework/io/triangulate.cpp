// Ear clipping: cut off a corner whose triangle holds no other corner, until a triangle is left.
#include "io/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>

namespace raysteps {
namespace {

using Point = glm::dvec2;

// The polygon's area times its normal, twice: the sum over the triangles of a fan (Newell's method).
glm::dvec3 area_vector(std::span<const glm::vec3> corners) {
    const glm::dvec3 start(corners[0]);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(glm::dvec3(corners[i]) - start, glm::dvec3(corners[i + 1]) - start);
    }
    return sum;
}

int largest_axis(const glm::dvec3& v) {
    const glm::dvec3 size = glm::abs(v);
    if (size.x >= size.y && size.x >= size.z) {
        return 0;
    }
    return size.y >= size.z ? 1 : 2;
}

// The polygon in the plane: without the coordinate in which its normal is largest, so that the least is lost. The
// result runs counter-clockwise, whichever way the polygon faces.
std::vector<Point> flatten(std::span<const glm::vec3> corners) {
    const glm::dvec3 normal = area_vector(corners);
    const int axis = largest_axis(normal);
    const int first = (axis + 1) % 3;
    const int second = (axis + 2) % 3;
    const bool turned_away = normal[axis] < 0.0;
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        const glm::dvec2 point(corner[first], corner[second]);
        flat.push_back(turned_away ? glm::dvec2(point.y, point.x) : point);
    }
    return flat;
}

// Points, sorted into square cells: those near a place are found without a look at all.
class PointGrid {
public:
    /// Takes the points whose numbers are in `chosen`; about as many cells as that. `points` must outlive the grid.
    PointGrid(std::span<const glm::dvec2> points, std::span<const std::size_t> chosen);

    /// Whether `accepts(number)` is true for any point in the rectangle. It is asked about near ones too.
    /// `work` grows by the number of cells and points looked at.
    template <typename Accepts>
    [[nodiscard]] bool any_in(const glm::dvec2& low, const glm::dvec2& high, std::size_t& work, Accepts accepts) const {
        for (std::size_t row = cell(low, 1); row <= cell(high, 1); ++row) {
            for (std::size_t column = cell(low, 0); column <= cell(high, 0); ++column) {
                const std::vector<std::size_t>& here = cells_[row * side_ + column];
                work += 1 + here.size();
                for (const std::size_t number : here) {
                    if (accepts(number)) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

private:
    [[nodiscard]] std::size_t cell(const glm::dvec2& point, int axis) const;

    glm::dvec2 low_{0.0};
    glm::dvec2 cells_per_unit_{0.0};
    std::size_t side_ = 1;  // cells along each axis
    std::vector<std::vector<std::size_t>> cells_;
};

PointGrid::PointGrid(std::span<const glm::dvec2> points, std::span<const std::size_t> chosen) {
    if (!chosen.empty()) {
        low_ = points[chosen.front()];
    }
    glm::dvec2 high = low_;
    for (const std::size_t number : chosen) {
        low_ = glm::min(low_, points[number]);
        high = glm::max(high, points[number]);
    }
    side_ = 1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(chosen.size())));
    for (int axis = 0; axis < 2; ++axis) {
        const double extent = high[axis] - low_[axis];
        cells_per_unit_[axis] = extent > 0.0 ? static_cast<double>(side_) / extent : 0.0;
    }
    cells_.resize(side_ * side_);
    for (const std::size_t number : chosen) {
        cells_[cell(points[number], 1) * side_ + cell(points[number], 0)].push_back(number);
    }
}

// What lies outside of the grid belongs to its outermost cells. Never falls as the coordinate rises.
std::size_t PointGrid::cell(const glm::dvec2& point, int axis) const {
    const double place = (point[axis] - low_[axis]) * cells_per_unit_[axis];
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(side_ - 1)));
}

// Corners and cells looked at before a polygon is given up: a second or two.
constexpr std::size_t k_max_work = 400'000'000;

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

    std::optional<std::vector<TriangleIndices>> run() {
        std::size_t left_at_refill = left_ + 1;
        while (left_ > 3 && work_ < k_max_work) {
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
            if (left_ > 3 && work_ < k_max_work && corners_[i].left && corners_[i].waits != round_ && is_ear(i)) {
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
    [[nodiscard]] bool blocks(std::size_t dent, std::size_t a, std::size_t b, std::size_t c) const {
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
        const std::size_t best = any_left();
        std::size_t i = best;
        for (std::size_t count = 0; count < left_; ++count, i = corners_[i].after) {
            ++work_;
            if (corners_[i].turn > 0.0) {
                return i;
            }
        }
        return best;
    }

    [[nodiscard]] std::size_t any_left() const { return start_; }

    std::span<const Point> points_;
    std::vector<Corner> corners_;
    std::size_t left_;
    std::size_t start_ = 0;
    PointGrid dents_;
    std::vector<std::size_t> next_;  // corners that the next round looks at
    std::size_t round_ = 0;
    std::size_t work_ = 0;
    std::vector<TriangleIndices> triangles_;
};

// Height over longest side, below which a triangle is a line in float arithmetic.
constexpr double k_thinnest = 1e-8;

// The corners without those that repeat the one before.
std::vector<std::size_t> distinct(std::span<const glm::vec3> corners) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (kept.empty() || corners[kept.back()] != corners[i]) {
            kept.push_back(i);
        }
    }
    while (kept.size() > 1 && corners[kept.front()] == corners[kept.back()]) {
        kept.pop_back();
    }
    return kept;
}

}  // namespace

bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 normal = glm::cross(b - a, c - a);
    if (!(glm::dot(normal, normal) >= std::numeric_limits<float>::min())) {
        return false;  // its normal could not be made unit length
    }
    const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a);
    const glm::dvec3 ac = glm::dvec3(c) - glm::dvec3(a);
    const glm::dvec3 bc = glm::dvec3(c) - glm::dvec3(b);
    const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    return glm::length(glm::cross(ab, ac)) > k_thinnest * longest;
}

std::optional<std::vector<TriangleIndices>> triangulate(std::span<const glm::vec3> corners) {
    const std::vector<std::size_t> kept = distinct(corners);
    if (kept.size() < 3) {
        return std::vector<TriangleIndices>{};
    }
    std::vector<glm::vec3> points;
    points.reserve(kept.size());
    for (const std::size_t i : kept) {
        points.push_back(corners[i]);
    }
    std::optional<std::vector<TriangleIndices>> ears = EarClipper(flatten(points)).run();
    if (!ears) {
        return std::nullopt;
    }
    std::vector<TriangleIndices> triangles;
    for (const auto& [a, b, c] : *ears) {
        if (has_area(points[a], points[b], points[c])) {
            triangles.push_back({kept[a], kept[b], kept[c]});
        }
    }
    return triangles;
}

}  // namespace raysteps
