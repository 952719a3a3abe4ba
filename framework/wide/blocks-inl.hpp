// Eight boxes, triangles or spheres against one ray. Included once for each set of instructions, so without the usual
// guard: this is the guard that the library for them asks for.
#if defined(RAYSTEPS_WIDE_BLOCKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYSTEPS_WIDE_BLOCKS_INL
#undef RAYSTEPS_WIDE_BLOCKS_INL
#else
#define RAYSTEPS_WIDE_BLOCKS_INL
#endif

#include <hwy/highway.h>

#include <cmath>
#include <limits>

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
    explicit BoxRay(const Ray& ray) : origin(ray.origin) {
        for (int axis = 0; axis < 3; ++axis) {
            constexpr float k_smallest = 1e-30F;  // a direction of 0 would give 0 * infinity on a box's wall
            const float along = ray.direction[axis];
            inverse[axis] = 1.0F / (std::abs(along) < k_smallest ? std::copysign(k_smallest, along) : along);
            backwards[static_cast<std::size_t>(axis)] = along < 0.0F || (along == 0.0F && std::signbit(along));
        }
    }

    glm::vec3 origin;
    glm::vec3 inverse{0.0F};
    std::array<bool, 3> backwards{};
};

/// The boxes that the ray meets before `limit`, a bit for each; where it enters them is written to `enters`.
HWY_INLINE std::uint32_t boxes_hit(const Node& node, const BoxRay& ray, float limit, Lanes& enters) {
    std::uint32_t hit = 0;
    for (std::size_t at = 0; at < k_lanes; at += hn::Lanes(D())) {
        V enter = hn::Zero(D());
        V leave = same(limit);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool back = ray.backwards[axis];
            const V origin = same(ray.origin[static_cast<int>(axis)]);
            const V inverse = same(ray.inverse[static_cast<int>(axis)]);
            const V near_wall = load((back ? node.high : node.low)[axis], at);
            const V far_wall = load((back ? node.low : node.high)[axis], at);
            enter = hn::Max(enter, (near_wall - origin) * inverse);
            leave = hn::Min(leave, (far_wall - origin) * inverse);
        }
        hn::Store(enter, D(), enters.data() + at);
        hit |= bits(enter * same(1.0F - k_distance_slack) <= leave, at);
    }
    return hit;
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
    std::uint32_t sure = 0;      ///< hit between `least` and `most`
    std::uint32_t doubtful = 0;  ///< hit or not
    HWY_ALIGN Lanes least;
    HWY_ALIGN Lanes most;
};

HWY_INLINE void write(Verdicts& verdicts, M sure, M possible, V distance, V error, std::size_t at) {
    verdicts.sure |= bits(sure, at);
    verdicts.doubtful |= bits(hn::AndNot(sure, possible), at);
    hn::Store(distance - error, D(), verdicts.least.data() + at);
    hn::Store(distance + error, D(), verdicts.most.data() + at);
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
        write(verdicts, sure, possible, distance, error, at);
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
        write(verdicts, sure, possible, hn::IfThenElse(in_front, nearer, farther), error, at);
    }
}

/// Never sure: only lines that pass the axis at more than the radius are out. (Both are lines here, without ends.)
HWY_INLINE void ask_block(const ConeBlock& block, const SurfaceRay& ray, float /*limit*/, Verdicts& verdicts) {
    const Vec3 direction = same(ray.direction);
    for (std::size_t at = 0; at < k_lanes; at += hn::Lanes(D())) {
        const Vec3 from_base = same(ray.origin) - load(block.base, at);
        const V radius = load(block.radius, at);
        const Vec3 across = cross(direction, load(block.axis, at));
        const V error = same(k_rounding) * (sum_of_sizes(from_base) + radius + same(ray.size));
        const V reach = hn::MulAdd(radius, hn::Sqrt(dot(across, across)), error);
        const M possible = hn::And(radius >= hn::Zero(D()), hn::Abs(dot(from_base, across)) <= reach);
        verdicts.doubtful |= bits(possible, at);
    }
}

}  // namespace raysteps::wide::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
