#pragma once
// What a ray can meet. Sphere and Triangle are the two that the steps deal with.
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "core/box.hpp"
#include "core/hit_record.hpp"
#include "core/ray.hpp"

namespace raysteps {

class Sphere;
class InwardSphere;
class Triangle;
class SmoothTriangle;
class MeshTriangle;
class Cone;
class Disk;

/// The shapes that a scene can hold, for whoever treats each in its own way: std::visit with ByShape. Stand-ins that
/// tests put into scenes are none of them.
using Shape = std::variant<std::monostate, const Sphere*, const InwardSphere*, const Triangle*, const SmoothTriangle*,
                           const MeshTriangle*, const Cone*, const Disk*>;

/// One function for each shape; the compiler says which one is missing.
template <typename... Functions>
struct ByShape : Functions... {
    using Functions::operator()...;
};
template <typename... Functions>
ByShape(Functions...) -> ByShape<Functions...>;

class Surface {
public:
    virtual ~Surface() = default;

    /// The nearest hit with distance > 0, or nothing. Counted as one surface test.
    [[nodiscard]] std::optional<HitRecord> hit(const Ray& ray) const;

    /// The smallest box around the whole surface.
    [[nodiscard]] virtual Box bounds() const = 0;

    /// Whether the surface may touch the box. A "yes" too many costs time; a "no" too many loses hits.
    [[nodiscard]] virtual bool overlaps(const Box& box) const = 0;

    [[nodiscard]] virtual Shape shape() const { return std::monostate{}; }

    [[nodiscard]] const Fill& fill() const { return fill_; }

    /// Place in the scene, from 0. Of two hits at the same distance, the surface that comes first counts.
    [[nodiscard]] std::size_t order() const { return order_; }

protected:
    explicit Surface(const Fill& fill) : fill_(fill) {}
    Surface(const Surface&) = default;
    Surface& operator=(const Surface&) = default;

    [[nodiscard]] virtual std::optional<HitRecord> intersect(const Ray& ray) const = 0;

private:
    friend class Scene;  // gives out the order

    Fill fill_;
    std::size_t order_ = 0;
};

/// Surfaces that somebody else owns, usually a Scene.
using SurfaceList = std::vector<const Surface*>;

}  // namespace raysteps
