// Eight boxes or surfaces against one ray. Included once for each set of instructions, so without the usual
// guard: this is the guard that the library for them asks for.
#if defined(RAYSTEPS_WIDE_BLOCKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYSTEPS_WIDE_BLOCKS_INL
#undef RAYSTEPS_WIDE_BLOCKS_INL
#else
#define RAYSTEPS_WIDE_BLOCKS_INL
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>

#include "core/ray.hpp"
#include "core/rounding.hpp"
#include "wide/tree.hpp"

HWY_BEFORE_NAMESPACE();
namespace raysteps::wide::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, k_lanes>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

/// Roundings that a test may go through, here or in Surface::hit, as a share of the numbers in it (about 70 of them).
constexpr float k_rounding = 4e-6F;

HWY_INLINE V load(const Lanes& lanes, std::size_t at) { return hn::Load(D(), lanes.data() + at); }
HWY_INLINE V same(float value) { return hn::Set(D(), value); }

struct Vec3 {
    V x, y, z;
};

HWY_INLINE Vec3 load(const std::array<Lanes, 3>& lanes, std::size_t at) {
    return {load(lanes[0], at), load(lanes[1], at), load(lanes[2], at)};
}
HWY_INLINE Vec3 same(const glm::vec3& value) { return {same(value.x), same(value.y), same(value.z)}; }
HWY_INLINE Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE V dot(const Vec3& a, const Vec3& b) { return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, a.z * b.z)); }
HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b) {
    return {hn::MulSub(a.y, b.z, a.z * b.y), hn::MulSub(a.z, b.x, a.x * b.z), hn::MulSub(a.x, b.y, a.y * b.x)};
}
HWY_INLINE V sum_of_sizes(const Vec3& a) { return hn::Abs(a.x) + hn::Abs(a.y) + hn::Abs(a.z); }

/// One bit per lane, from bit `at` on.
HWY_INLINE std::uint32_t bits(M mask, std::size_t at) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(D(), mask, bytes);
    return static_cast<std::uint32_t>(bytes[0]) << at;
}

/// A ray as the boxes want it.
struct BoxRay {
    explicit BoxRay(const Ray& ray) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            constexpr float k_smallest = 1e-20F;  // a direction of 0 would give 0 * infinity on a box's wall
            const float along = ray.direction[static_cast<int>(axis)];
            const float inverse = 1.0F / (std::abs(along) < k_smallest ? std::copysign(k_smallest, along) : along);
            const float offset = ray.origin[static_cast<int>(axis)] * inverse;
            near_walls[axis] = {axis + (std::signbit(along) ? 3 : 0), inverse * (1.0F - k_distance_slack),
                                offset * (1.0F - k_distance_slack)};
            far_walls[axis] = {axis + (std::signbit(along) ? 0 : 3), inverse, offset};
        }
    }

    /// The distance of a wall is its coordinate times `inverse`, less `offset`.
    struct Side {
        std::size_t wall;  ///< of Node::walls
        float inverse;
        float offset;
    };
    std::array<Side, 3> near_walls;  ///< with some slack
    std::array<Side, 3> far_walls;
};

/// Which of the boxes from `at` on the ray meets before `limit`; where it enters them, with some slack, is `enter`.
HWY_INLINE M boxes_hit(const Node& node, const BoxRay& ray, float limit, std::size_t at, V& enter) {
    const auto distance = [&](const BoxRay::Side& side) HWY_ATTR {
        return hn::MulSub(load(node.walls[side.wall], at), same(side.inverse), same(side.offset));
    };
    enter = hn::Max(hn::Max(distance(ray.near_walls[0]), distance(ray.near_walls[1])),
                    hn::Max(distance(ray.near_walls[2]), hn::Zero(D())));
    const V leave = hn::Min(hn::Min(distance(ray.far_walls[0]), distance(ray.far_walls[1])),
                            hn::Min(distance(ray.far_walls[2]), same(limit)));
    return enter <= leave;
}

/// The boxes that the ray meets before `limit`, a bit for each; where it enters them is written to `enters`.
HWY_INLINE std::uint32_t boxes_hit(const Node& node, const BoxRay& ray, float limit, Lanes& enters) {
    std::uint32_t hit = 0;
    for (std::size_t at = 0; at < k_lanes; at += hn::Lanes(D())) {
        V enter;
        hit |= bits(boxes_hit(node, ray, limit, at, enter), at);
        hn::Store(enter, D(), enters.data() + at);
    }
    return hit;
}

/// As boxes_hit. What they lead to is written to `to`, in the order of the bits; up to eight places are overwritten.
HWY_INLINE std::uint32_t push_hit(const Node& node, const BoxRay& ray, float limit, Reference* to) {
    const hn::RebindToUnsigned<D> du;
    std::uint32_t all = 0;
    for (std::size_t at = 0; at < k_lanes; at += hn::Lanes(D())) {
        V enter;
        const M hit = boxes_hit(node, ray, limit, at, enter);
        const auto part = hn::Load(du, reinterpret_cast<const std::uint32_t*>(node.to.data() + at));
        hn::StoreU(hn::Compress(part, hn::RebindMask(du, hit)), du,
                   reinterpret_cast<std::uint32_t*>(to + std::popcount(all)));
        all |= bits(hit, at);
    }
    return all;
}

/// A ray as the surfaces want it.
struct SurfaceRay {
    explicit SurfaceRay(const Ray& ray)
        : origin(ray.origin),
          direction(ray.direction),
          size(std::abs(ray.origin.x) + std::abs(ray.origin.y) + std::abs(ray.origin.z)) {}

    glm::vec3 origin;
    glm::vec3 direction;
    float size;  ///< of the origin's coordinates, which is the size of their rounding
};

/// What is known of the surfaces of a block, a bit for each.
struct Verdicts {
    std::uint32_t sure = 0;      ///< hit between `least` and `most`, before the limit
    std::uint32_t doubtful = 0;  ///< hit or not
    HWY_ALIGN Lanes least;
    HWY_ALIGN Lanes most;
};

/// `sure` counts where it is possible.
HWY_INLINE void write(Verdicts& verdicts, M sure, M possible, V distance, V error, float limit, std::size_t at) {
    const V most = distance + error;
    const M before = hn::And(hn::And(sure, possible), most < same(limit));
    verdicts.sure |= bits(before, at);
    verdicts.doubtful |= bits(hn::AndNot(before, possible), at);
    hn::Store(distance - error, D(), verdicts.least.data() + at);
    hn::Store(most, D(), verdicts.most.data() + at);
}

/// Moller and Trumbore (1997), before any division: u, v and w are the weights of the corners times `det`.
HWY_INLINE void ask_block(const TriangleBlock& block, const SurfaceRay& ray, float limit, Verdicts& verdicts) {
    const Vec3 direction = same(ray.direction);
    for (std::size_t at = 0; at < k_lanes; at += hn::Lanes(D())) {
        const Vec3 ab = load(block.edge_ab, at);
        const Vec3 ac = load(block.edge_ac, at);
        const Vec3 from_corner = same(ray.origin) - load(block.corner, at);
        const Vec3 p = cross(direction, ac);
        const Vec3 q = cross(from_corner, ab);
        const V signed_det = dot(ab, p);
        const V sign = hn::And(signed_det, hn::SignBit(D()));
        const V det = hn::Abs(signed_det);
        const V u = hn::Xor(dot(from_corner, p), sign);
        const V v = hn::Xor(dot(direction, q), sign);
        const V w = det - u - v;
        const V way = hn::Xor(dot(ac, q), sign);  // the distance times det

        const V longest = load(block.longest, at);
        const V sliver = load(block.sliver_bound, at);
        const V size = same(k_rounding) * (sum_of_sizes(from_corner) + longest + same(ray.size));
        const V side_error = sliver * size;
        const V det_error = same(k_rounding) * load(block.area_bound, at);
        const V way_error = load(block.area_bound, at) * size;
        const V least_weight = hn::Min(u, hn::Min(v, w));

        const M used = sliver >= hn::Zero(D());
        const M inside = least_weight >= hn::Neg(side_error);
        const M before = (way - way_error) <= same(limit) * (det + det_error);
        const M possible = hn::And(hn::And(used, inside), hn::And(before, way >= hn::Neg(way_error)));
        if (hn::AllFalse(D(), possible)) {
            continue;
        }
        const M well_inside = hn::And(least_weight > side_error, det > same(16.0F) * det_error);
        const M sure = hn::And(possible, hn::And(well_inside, way > way_error));
        const V inverse = same(1.0F) / hn::Max(det, same(1e-37F));
        const V distance = way * inverse;
        const V error = (way_error + distance * det_error) * inverse * same(1.25F);
        write(verdicts, sure, possible, distance, error, limit, at);
    }
}

/// The chord around the point of the ray that is closest to the centre.
HWY_INLINE void ask_block(const SphereBlock& block, const SurfaceRay& ray, float limit, Verdicts& verdicts) {
    const Vec3 direction = same(ray.direction);
    for (std::size_t at = 0; at < k_lanes; at += hn::Lanes(D())) {
        const Vec3 to_center = load(block.center, at) - same(ray.origin);
        const V radius = load(block.radius, at);
        const V along = dot(to_center, direction);
        const Vec3 apart{to_center.x - along * direction.x, to_center.y - along * direction.y,
                         to_center.z - along * direction.z};
        const V square = radius * radius - dot(apart, apart);
        const V point_error = same(k_rounding) * (sum_of_sizes(to_center) + radius + same(ray.size));
        const V square_error = (radius + radius + point_error) * point_error;

        const M used = radius >= hn::Zero(D());
        const V half_chord = hn::Sqrt(hn::Max(square, square_error));
        const V error = (point_error + square_error / half_chord) * same(1.25F);
        const V nearer = along - half_chord;
        const V farther = along + half_chord;
        const M possible = hn::And(hn::And(used, square >= hn::Neg(square_error)),
                                   hn::And(farther >= hn::Neg(error), nearer - error <= same(limit)));
        if (hn::AllFalse(D(), possible)) {
            continue;
        }
        const M in_front = nearer > error;
        const M from_within = hn::And(nearer<hn::Neg(error), farther> error);
        const M sure = hn::And(hn::And(possible, square > square_error + square_error), hn::Or(in_front, from_within));
        write(verdicts, sure, possible, hn::IfThenElse(in_front, nearer, farther), error, limit, at);
    }
}

/// Where a line meets the wall of a cone, and whether that counts.
struct ConeRoot {
    V distance;
    M sure;
    M possible;
};

/// `most`: the error of the distance; that of the height is at most twice as large.
HWY_INLINE ConeRoot cone_root(V distance, V most, V height, V length, float limit) {
    const V slack = most + most;
    const M sure = hn::And(distance > most, hn::And(height > slack, height < length - slack));
    const M within = hn::And(height >= hn::Neg(slack), height <= length + slack);
    const M before = hn::And(distance >= hn::Neg(most), distance - most <= same(limit));
    return {distance, sure, hn::And(within, before)};
}

/// As Cone::intersect, from the point of the ray that is closest to the axis: there the wall's radius is `around`. A
/// ray that runs nearly along the axis or the wall leaves all in doubt that it passes at less than the largest radius.
HWY_INLINE void ask_block(const ConeBlock& block, const SurfaceRay& ray, float limit, Verdicts& verdicts) {
    const Vec3 direction = same(ray.direction);
    for (std::size_t at = 0; at < k_lanes; at += hn::Lanes(D())) {
        const Vec3 from_base = same(ray.origin) - load(block.base, at);
        const Vec3 axis = load(block.axis, at);
        const V radius = load(block.radius, at);
        const V slope = load(block.slope, at);
        const V length = load(block.length, at);
        const Vec3 normal = cross(direction, axis);
        const V across = dot(normal, normal);  // square of the direction's part across the axis
        const V inverse = same(1.0F) / across;
        const V beside = dot(from_base, normal);
        const V rise = dot(direction, axis);
        const V height = dot(from_base, axis);
        const V closest = hn::MulSub(height, rise, dot(from_base, direction)) * inverse;
        const V around = hn::MulAdd(slope, hn::MulAdd(closest, rise, height), radius);
        const V growth = slope * rise;
        const V leading = across - growth * growth;
        const V square = across * around * around - beside * beside * leading * inverse;

        const V steepness = same(1.0F) + hn::Abs(slope);
        const V size = sum_of_sizes(from_base) + radius + length;
        const V error = same(k_rounding) * steepness * size;
        const V rounding = same(k_rounding) * steepness * steepness * inverse;
        const V point_error = error * inverse;
        const V square_error = same(4.0F) * point_error * (hn::Abs(around) + hn::Abs(beside) + point_error) +
                               rounding * (around * around + beside * beside);

        const V largest = hn::Max(radius, hn::MulAdd(slope, length, radius));
        const M near_axis = beside * beside <= same(2.0F) * (across * largest * largest + error * error);
        const M met = hn::And(radius >= hn::Zero(D()), near_axis);
        const M clear = hn::And(across > same(0.01F), leading > same(0.25F) * across);
        const M open = hn::AndNot(hn::And(clear, square < hn::Neg(square_error)), met);
        if (hn::AllFalse(D(), open)) {
            continue;
        }
        const V shrink = same(1.0F) / leading;
        const V half_chord = hn::Sqrt(hn::Max(square, square_error));
        const V middle = hn::MulAdd(growth * around, shrink, closest);
        const V half = half_chord * shrink;
        const V most = point_error + (steepness * point_error + square_error / half_chord +
                                      rounding * (hn::Abs(growth * around) + half_chord) * shrink) *
                                         shrink;
        const ConeRoot near_root =
            cone_root(middle - half, most, hn::MulAdd(middle - half, rise, height), length, limit);
        const ConeRoot far_root =
            cone_root(middle + half, most, hn::MulAdd(middle + half, rise, height), length, limit);
        const M outside = load(block.outside, at) > hn::Zero(D());
        const M enters = hn::And(outside, near_root.possible);
        const M sure_near = hn::And(outside, near_root.sure);
        const M sure = hn::And(hn::And(clear, square > square_error + square_error),
                               hn::Or(sure_near, hn::AndNot(enters, far_root.sure)));
        const M possible = hn::Or(hn::Not(clear), hn::Or(enters, far_root.possible));
        const V distance = hn::IfThenElse(sure_near, near_root.distance, far_root.distance);
        write(verdicts, sure, hn::And(open, possible), distance, most, limit, at);
    }
}

}  // namespace raysteps::wide::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
