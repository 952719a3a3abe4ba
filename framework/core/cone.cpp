#include "core/cone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/rounding.hpp"

namespace raysteps {
namespace {

using Vec = glm::dvec3;

// The roots of a t^2 + 2 b t + c = 0 in rising order, without cancellation. One root may be infinite or NaN.
std::optional<std::array<double, 2>> roots(double a, double b, double c) {
    const double under_root = b * b - a * c;
    if (under_root < 0.0) {
        return std::nullopt;
    }
    const double q = -(b + std::copysign(std::sqrt(under_root), b));
    const double first = q / a;
    const double second = q != 0.0 ? c / q : first;
    return first < second ? std::array{first, second} : std::array{second, first};
}

}  // namespace

Cone::Cone(const End& base, const End& apex, Sidedness sidedness, const Fill& fill)
    : Surface(fill),
      base_(base),
      apex_(apex),
      sidedness_(sidedness),
      axis_(glm::normalize(Vec(apex.center) - Vec(base.center))),
      length_(glm::length(Vec(apex.center) - Vec(base.center))),
      slope_((static_cast<double>(apex.radius) - static_cast<double>(base.radius)) / length_) {}

// A point is on the wall when its distance from the axis is base radius + slope * height, height being measured
// along the axis from the base. The equation is solved from the point of the ray closest to the axis: solved from
// the ray's origin, the square of a far origin would swallow that of a thin cone's radius. Of a ray along the axis it
// is the closest point that is far away, and its square that would swallow the radius; there the origin is as close.
std::optional<HitRecord> Cone::intersect(const Ray& ray) const {
    const Vec direction(ray.direction);
    const double rise = glm::dot(direction, axis_);
    const Vec across = direction - rise * axis_;
    const double across2 = glm::dot(across, across);
    const Vec origin = Vec(ray.origin) - Vec(base_.center);
    constexpr double k_along = 1e-8;
    const double closest = across2 > k_along ? -glm::dot(origin, across) / across2 : 0.0;

    const Vec start = origin + closest * direction;
    const double height = glm::dot(start, axis_);
    const Vec apart = start - height * axis_;
    const double radius = static_cast<double>(base_.radius) + slope_ * height;
    const double growth = slope_ * rise;
    const auto meetings = roots(across2 - growth * growth, glm::dot(across, apart) - growth * radius,
                                glm::dot(apart, apart) - radius * radius);
    if (!meetings) {
        return std::nullopt;
    }
    const auto nearer = wall_hit(ray, closest + meetings->front());
    return nearer ? nearer : wall_hit(ray, closest + meetings->back());
}

// The record for a point where the ray meets the endless cone, if that point counts.
std::optional<HitRecord> Cone::wall_hit(const Ray& ray, double distance) const {
    if (!(static_cast<float>(distance) > 0.0F) || !std::isfinite(distance)) {
        return std::nullopt;
    }
    const Vec from_base = (Vec(ray.origin) - Vec(base_.center)) + distance * Vec(ray.direction);
    const double height = glm::dot(from_base, axis_);
    if (!(height >= 0.0 && height <= length_)) {
        return std::nullopt;
    }
    const Vec spoke = from_base - height * axis_;
    const double radius = glm::length(spoke);
    const Vec outward = radius > 0.0 ? glm::normalize(spoke / radius - slope_ * axis_) : -Vec(ray.direction);
    const bool meets_outside = glm::dot(outward, Vec(ray.direction)) <= 0.0;
    if (sidedness_ == Sidedness::inside && meets_outside) {
        return std::nullopt;
    }
    HitRecord hit;
    hit.position = glm::vec3(from_base + Vec(base_.center));
    hit.fill = fill();
    hit.normal = glm::vec3(meets_outside ? outward : -outward);
    hit.ray_direction = ray.direction;
    hit.distance = static_cast<float>(distance);
    hit.front_face = meets_outside || sidedness_ == Sidedness::inside;
    return hit;
}

// A disc of radius r about an axis reaches r * sqrt(1 - axis_x^2) along x.
Box Cone::bounds() const {
    const Vec reach = glm::sqrt(glm::max(Vec(0.0), Vec(1.0) - axis_ * axis_));
    const Vec base(base_.center);
    const Vec apex(apex_.center);
    const double base_radius = base_.radius;
    const double apex_radius = apex_.radius;
    const Vec low = glm::min(base - base_radius * reach, apex - apex_radius * reach);
    const Vec high = glm::max(base + base_radius * reach, apex + apex_radius * reach);
    return rounded_outwards(low, high);
}

// Three planes that may part the two: the sides of the bounds, the ends of the axis, and one that touches the
// wall on the side of the box's centre.
bool Cone::overlaps(const Box& box) const {
    const Box around = bounds();
    for (int i = 0; i < 3; ++i) {
        if (around.min[i] > box.max[i] || around.max[i] < box.min[i]) {
            return false;
        }
    }
    const Vec half = 0.5 * (Vec(box.max) - Vec(box.min));
    const Vec center = 0.5 * (Vec(box.max) + Vec(box.min)) - Vec(base_.center);
    const double slack = 1e-6 * (glm::length(half) + glm::length(center) + length_);  // hits are rounded to float
    const double height = glm::dot(center, axis_);
    const double half_height = glm::dot(glm::abs(axis_), half) + slack;
    const double low = std::max(0.0, height - half_height);
    const double high = std::min(length_, height + half_height);
    if (low > high) {
        return false;
    }
    const Vec spoke = center - height * axis_;
    const double apart = glm::length(spoke);
    if (!(apart > 0.0)) {
        return true;
    }
    const double largest = static_cast<double>(base_.radius) + std::max(slope_ * low, slope_ * high);
    const double half_width = glm::dot(glm::abs(spoke / apart), half) + slack;
    return apart - half_width <= largest;
}

}  // namespace raysteps
