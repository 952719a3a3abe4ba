// Surfaces described at one end and copied at the other.
#include "remote/groups.hpp"

#include "core/cone.hpp"
#include "core/disk.hpp"
#include "core/inward_sphere.hpp"
#include "core/mesh_triangle.hpp"
#include "core/smooth_triangle.hpp"
#include "remote/serializer.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::remote;
using namespace raysteps::testing;

namespace {

const Fill k_fill{.color = {0.1F, 0.2F, 0.3F},
                  .kd = 0.4F,
                  .ks = 0.5F,
                  .shine = 6.0F,
                  .transmittance = 0.7F,
                  .index_of_refraction = 1.8F};

Scene one_of_each() {
    Scene scene;
    scene.add(std::make_unique<Sphere>(glm::vec3(1.0F, 2.0F, 3.0F), 0.5F, k_fill));
    scene.add(
        std::make_unique<Triangle>(glm::vec3(0.0F), glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 1.0F, 0.0F), k_fill));
    const glm::vec3 up(0.0F, 0.0F, 1.0F);
    scene.add(std::make_unique<SmoothTriangle>(SmoothTriangle::Corner{{0.0F, 0.0F, 1.0F}, up},
                                               SmoothTriangle::Corner{{1.0F, 0.0F, 1.0F}, up},
                                               SmoothTriangle::Corner{{0.0F, 1.0F, 1.0F}, up}, k_fill));
    scene.add(std::make_unique<Cone>(Cone::End{{0.0F, 0.0F, 0.0F}, 1.0F}, Cone::End{{0.0F, 0.0F, 2.0F}, 0.5F},
                                     Cone::Sidedness::both, k_fill));
    scene.add(std::make_unique<InwardSphere>(glm::vec3(0.0F), 9.0F, k_fill));
    return scene;
}

}  // namespace

TEST_CASE("copies look like the surfaces that they stand for", "[remote]") {
    const Scene scene = one_of_each();
    SurfaceList some(scene.surfaces().rbegin(), scene.surfaces().rend() - 1);  // in another order, and not all
    Groups here;
    Groups there;
    std::string bytes;
    Writer out(bytes);
    const Loan loan(here.write(out, some));
    Reader in(bytes);
    const std::shared_ptr<CopiedGroup> copies = there.read(in);
    CHECK(in.at_end());
    REQUIRE(copies->scene.surfaces().size() == some.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
        const Surface& copy = *copies->scene.surfaces()[i];
        CAPTURE(i);
        CHECK(copy.order() == some[i]->order());
        CHECK(copy.bounds().min == some[i]->bounds().min);
        CHECK(copy.bounds().max == some[i]->bounds().max);
        CHECK(copy.fill().color == k_fill.color);
        CHECK(copy.fill().index_of_refraction == k_fill.index_of_refraction);
        const SurfaceRef* place = there.place_of(&copy);
        REQUIRE(place != nullptr);
        CHECK(&here.lent(*place) == some[i]);
        CHECK(there.place_of(some[i]) == nullptr);
    }
}

TEST_CASE("a group is described once, and again when a surface has changed", "[remote]") {
    Groups groups;
    Sphere sphere({0.0F, 0.0F, 0.0F}, 1.0F, k_fill);
    const SurfaceList list{&sphere};
    std::string first;
    std::string second;
    std::string third;
    Writer once(first);
    const std::shared_ptr<OwnGroup> group = groups.write(once, list);
    Writer again(second);
    CHECK(groups.write(again, list) == group);
    CHECK(second.size() < first.size());
    CHECK(Groups::is_unchanged(*group));
    sphere = Sphere({0.0F, 0.0F, 5.0F}, 1.0F, k_fill);
    CHECK_FALSE(Groups::is_unchanged(*group));
    Writer changed(third);
    CHECK(groups.write(changed, list) != group);
    CHECK(third.size() == first.size());
}

TEST_CASE("a group is described once in work that changes nothing", "[remote]") {
    Groups groups;
    Sphere sphere({0.0F, 0.0F, 0.0F}, 1.0F, k_fill);
    const SurfaceList list{&sphere};
    const auto bytes_written = [&](std::uint64_t together) {
        std::string bytes;
        Writer out(bytes);
        groups.write(out, list, together);
        return bytes.size();
    };
    const std::size_t whole = bytes_written(1);
    sphere = Sphere({0.0F, 0.0F, 5.0F}, 1.0F, k_fill);
    CHECK(bytes_written(1) < whole);
    CHECK(bytes_written(2) == whole);
    CHECK(bytes_written(2) < whole);
    CHECK(bytes_written(0) < whole);
}

TEST_CASE("only what an open question has lent can be asked for", "[remote]") {
    Groups groups;
    const Scene scene = one_of_each();
    std::string bytes;
    Writer out(bytes);
    const std::shared_ptr<OwnGroup> group = groups.write(out, scene.surfaces());
    CHECK_THROWS_AS(groups.lent({group->id, 0}), BadMessage);
    {
        const Loan loan(group);
        CHECK(&groups.lent({group->id, 1}) == scene.surfaces()[1]);
        CHECK_THROWS_AS(groups.lent({group->id, 5}), BadMessage);
        CHECK_THROWS_AS(groups.lent({group->id + 1, 0}), BadMessage);
    }
    CHECK_THROWS_AS(groups.lent({group->id, 1}), BadMessage);
}

TEST_CASE("Of a mesh the other end knows the triangle and its mark", "[remote]") {
    MeshFace face{MeshCorner{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}},
                  MeshCorner{{1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}},
                  MeshCorner{{0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}}};
    Scene scene;
    scene.add(std::make_unique<Sphere>(glm::vec3(9.0F), 1.0F, k_fill));
    scene.add(std::make_unique<MeshTriangle>(face, k_fill, nullptr));
    Groups here;
    Groups there;
    std::string bytes;
    Writer out(bytes);
    const auto own = here.write(out, scene.surfaces());
    Reader in(bytes);
    const auto copied = there.read(in);
    const Shape shape = copied->scene.surfaces().at(1)->shape();
    REQUIRE(std::holds_alternative<const MeshTriangle*>(shape));
    CHECK(std::get<const MeshTriangle*>(shape)->b() == face[1].position);
    const auto hit = std::get<const MeshTriangle*>(shape)->intersect({{0.2F, 0.2F, 3.0F}, {0.0F, 0.0F, -1.0F}});
    REQUIRE(hit.has_value());
    CHECK(hit->mesh_triangle == 2);
}

TEST_CASE("A disk and its light travel", "[remote]") {
    Fill fill = k_fill;
    fill.emission = {1.0F, 2.0F, 3.0F};
    Scene scene;
    scene.add(std::make_unique<Disk>(glm::vec3(1.0F), glm::vec3(0.0F, 0.0F, 1.0F), 2.0F, fill));
    Groups here;
    Groups there;
    std::string bytes;
    Writer out(bytes);
    const auto own = here.write(out, scene.surfaces());
    Reader in(bytes);
    const auto copied = there.read(in);
    const Shape shape = copied->scene.surfaces().at(0)->shape();
    REQUIRE(std::holds_alternative<const Disk*>(shape));
    const Disk* disk = std::get<const Disk*>(shape);
    CHECK(disk->center() == glm::vec3(1.0F));
    CHECK(disk->normal() == glm::vec3(0.0F, 0.0F, 1.0F));
    CHECK(disk->radius() == 2.0F);
    CHECK(disk->fill().emission == fill.emission);
}

TEST_CASE("A sample of a path travels, and so does none", "[remote]") {
    const ScatterSample sample{
        .direction = {0.0F, 0.6F, 0.8F}, .weight = {0.1F, 0.2F, 0.3F}, .pdf = 0.25F, .specular = true};
    std::string bytes;
    Writer out(bytes);
    write(out, std::optional(sample));
    write(out, std::optional<ScatterSample>());
    Reader in(bytes);
    const auto read_back = read<std::optional<ScatterSample>>(in);
    REQUIRE(read_back.has_value());
    CHECK(read_back->direction == sample.direction);
    CHECK(read_back->weight == sample.weight);
    CHECK(read_back->pdf == sample.pdf);
    CHECK(read_back->specular);
    CHECK_FALSE(read<std::optional<ScatterSample>>(in).has_value());
    CHECK(in.at_end());
}
