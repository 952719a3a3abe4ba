#include "remote/groups.hpp"

#include <typeinfo>
#include <variant>

#include "core/cone.hpp"
#include "core/disk.hpp"
#include "core/mesh_triangle.hpp"
#include "core/smooth_triangle.hpp"
#include "remote/lent.hpp"
#include "remote/searches.hpp"
#include "remote/serializer.hpp"

namespace raysteps::remote {
namespace {

/// Both ends remember the same groups, whatever else they still hold.
GroupId oldest_kept(GroupId newest) {
    constexpr GroupId k_kept = 8;
    return newest > k_kept ? newest - k_kept : 0;
}

enum class Look : std::uint8_t { sphere, triangle, smooth_triangle, mesh_triangle, cone, disk, other };

/// Looks like a box from outside. What a ray meets in it only the other end knows.
class UnknownSurface final : public Surface {
public:
    UnknownSurface(const Box& bounds, const Fill& fill) : Surface(fill), bounds_(bounds) {}

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override { return ask_hit(*this, ray); }
    [[nodiscard]] Box bounds() const override { return bounds_; }
    [[nodiscard]] bool overlaps(const Box& box) const override { return ask_overlaps(*this, box); }

private:
    Box bounds_;
};

class NoSurface final : public Surface {
public:
    NoSurface() : Surface(Fill{}) {}

    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& /*ray*/) const override { return std::nullopt; }
    [[nodiscard]] Box bounds() const override { return {}; }
    [[nodiscard]] bool overlaps(const Box& /*box*/) const override { return false; }
};

void describe(Writer& out, const Surface& surface) {
    const auto other = [&](const auto& /*shape*/) {
        out.put(Look::other);
        write(out, surface.bounds());
        write(out, surface.fill());
    };
    std::visit(
        ByShape{[&](const Sphere* sphere) {
                    out.put(Look::sphere);
                    write(out, *sphere);
                },
                [&](const Triangle* triangle) {
                    out.put(Look::triangle);
                    write(out, *triangle);
                },
                [&](const SmoothTriangle* triangle) {
                    out.put(Look::smooth_triangle);
                    write<Triangle>(out, *triangle);
                    for (const glm::vec3& normal : {triangle->normal_a(), triangle->normal_b(), triangle->normal_c()}) {
                        write(out, normal);
                    }
                },
                [&](const MeshTriangle* triangle) {
                    out.put(Look::mesh_triangle);
                    write<Triangle>(out, *triangle);
                },
                [&](const Cone* cone) {
                    out.put(Look::cone);
                    for (const Cone::End& end : {cone->base(), cone->apex()}) {
                        write(out, end.center);
                        out.put(end.radius);
                    }
                    out.put(cone->sidedness());
                    write(out, cone->fill());
                },
                [&](const Disk* disk) {
                    out.put(Look::disk);
                    write(out, disk->center());
                    write(out, disk->normal());
                    out.put(disk->radius());
                    write(out, disk->fill());
                },
                [&](const InwardSphere* sphere) { other(sphere); }, [&](std::monostate nothing) { other(nothing); }},
        surface.shape());
    out.put(static_cast<std::uint64_t>(surface.order()));
}

std::string description_of(const SurfaceList& surfaces) {
    std::string description;
    Writer out(description);
    out.put(static_cast<std::uint32_t>(surfaces.size()));
    for (const Surface* surface : surfaces) {
        describe(out, *surface);
    }
    return description;
}

Cone::End read_end(Reader& in) {
    const auto center = read<glm::vec3>(in);
    return {.center = center, .radius = in.get<float>()};
}

std::unique_ptr<Surface> copy(Reader& in) {
    switch (in.get<Look>()) {
        case Look::sphere:
            return std::make_unique<Sphere>(read<Sphere>(in));
        case Look::triangle:
            return std::make_unique<Triangle>(read<Triangle>(in));
        case Look::smooth_triangle: {
            const auto flat = read<Triangle>(in);
            const auto normals = read<std::array<glm::vec3, 3>>(in);
            return std::make_unique<SmoothTriangle>(SmoothTriangle::Corner{flat.a(), normals[0]},
                                                    SmoothTriangle::Corner{flat.b(), normals[1]},
                                                    SmoothTriangle::Corner{flat.c(), normals[2]}, flat.fill());
        }
        case Look::mesh_triangle: {  // whose hits are marked; what comes of the mark is done at home
            const auto flat = read<Triangle>(in);
            const MeshFace face{MeshCorner{.position = flat.a()}, MeshCorner{.position = flat.b()},
                                MeshCorner{.position = flat.c()}};
            return std::make_unique<MeshTriangle>(face, flat.fill(), nullptr);
        }
        case Look::cone: {
            const Cone::End base = read_end(in);
            const Cone::End apex = read_end(in);
            const auto sidedness = in.get<Cone::Sidedness>();
            return std::make_unique<Cone>(base, apex, sidedness, read<Fill>(in));
        }
        case Look::disk: {
            const auto center = read<glm::vec3>(in);
            const auto normal = read<glm::vec3>(in);
            const auto radius = in.get<float>();
            return std::make_unique<Disk>(center, normal, radius, read<Fill>(in));
        }
        case Look::other: {
            const Box bounds = read<Box>(in);
            return std::make_unique<UnknownSurface>(bounds, read<Fill>(in));
        }
    }
    throw BadMessage("a surface is of no known kind");
}

}  // namespace

Groups& Groups::all() {
    static Groups groups;
    return groups;
}

bool Groups::is_unchanged(const OwnGroup& group) { return group.description == description_of(group.surfaces); }

std::shared_ptr<OwnGroup> Groups::write(Writer& out, const SurfaceList& surfaces, std::uint64_t together) {
    std::string description;
    for (auto recent = own_.upper_bound(oldest_kept(last_)); recent != own_.end(); ++recent) {
        const std::shared_ptr<OwnGroup>& group = recent->second;
        if (group->surfaces != surfaces) {
            continue;
        }
        const bool is_known = together != 0 && group->described_in == together;
        if (!is_known && description.empty()) {
            description = description_of(surfaces);
        }
        if (is_known || group->description == description) {
            group->described_in = together;
            out.put(group->id);
            out.put(false);
            return group;
        }
    }
    if (description.empty()) {
        description = description_of(surfaces);
    }
    auto group = std::make_shared<OwnGroup>(OwnGroup{++last_, surfaces, std::move(description), together, 0, {}});
    own_[group->id] = group;
    std::erase_if(own_,
                  [&](const auto& one) { return one.first <= oldest_kept(last_) && one.second.use_count() == 1; });
    out.put(group->id);
    out.put(true);
    out.put(group->description);
    return group;
}

std::shared_ptr<CopiedGroup> Groups::read(Reader& in) {
    const auto id = in.get<GroupId>();
    if (in.get<bool>()) {
        return make_copies(id, in.text());
    }
    const auto found = copied_.find(id);
    if (found == copied_.end()) {
        throw BadMessage("these surfaces are not known here");
    }
    return found->second;
}

std::shared_ptr<CopiedGroup> Groups::make_copies(GroupId id, std::string_view description) {
    if (!copied_.empty() && id <= copied_.rbegin()->first && Session::current().side() == Session::Side::home) {
        throw BadMessage("surfaces were described in another order than that of their numbers");
    }
    auto group = std::shared_ptr<CopiedGroup>(new CopiedGroup{id, {}}, [this](CopiedGroup* last) {
        for (const Surface* surface : last->scene.surfaces()) {
            places_.erase(surface);
        }
        delete last;
    });
    Reader in(description);
    const std::size_t count = in.count(1);
    for (std::size_t i = 0; i < count; ++i) {
        std::unique_ptr<Surface> surface = copy(in);
        const auto order = static_cast<std::size_t>(in.get<std::uint64_t>());
        places_[surface.get()] = {id, static_cast<std::uint32_t>(i)};
        group->scene.add(std::move(surface), order);
    }
    copied_[id] = group;
    copied_.erase(copied_.begin(), copied_.upper_bound(oldest_kept(id)));
    return group;
}

OwnGroup& Groups::lent_group(GroupId id) const {
    const auto found = own_.find(id);
    if (found == own_.end() || found->second->lent == 0) {
        throw BadMessage("a surface was asked that no open question has lent");
    }
    return *found->second;
}

const Surface& Groups::lent(SurfaceRef place) const {
    const OwnGroup& group = lent_group(place.group);
    if (place.index >= group.surfaces.size()) {
        throw BadMessage("a surface was asked that is not there");
    }
    return *group.surfaces[place.index];
}

UseGuard Groups::use(GroupId group) const { return UseGuard(lent_group(group).uses); }

const SurfaceRef* Groups::place_of(const Surface* surface) const {
    const auto found = places_.find(surface);
    return found == places_.end() ? nullptr : &found->second;
}

bool is_asked(const Surface& surface) {
    const std::type_info* type = &typeid(surface);  // one program: each type has one
    return type == &typeid(LeafEntry) || type == &typeid(UnknownSurface);
}

const Surface& no_surface() {
    static const NoSurface nothing;
    return nothing;
}

}  // namespace raysteps::remote
