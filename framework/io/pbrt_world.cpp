#include "io/pbrt_world.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "core/disk.hpp"
#include "core/sphere.hpp"
#include "io/files.hpp"
#include "io/obj_reader.hpp"
#include "io/pbrt_mesh.hpp"
#include "io/ply_reader.hpp"

namespace raysteps {
namespace {

constexpr float k_sun_distance = 1e5F;

glm::vec3 flat_normal(const MeshData& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const glm::vec3& a = mesh.positions[triangle[0]];
    return glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
}

float radius_of(const PbrtScanner& scanner, const PbrtParameters& parameters, double size) {
    const float radius = static_cast<float>(size) * parameters.number("radius", 1.0F);
    if (!(radius > 0.0F && radius <= k_farthest)) {
        scanner.fail(parameters.directive(), "a radius above 0", "another one");
    }
    return radius;
}

}  // namespace

// Lights do not fall off with the distance, as in part one.
void PbrtWorld::read_light(PbrtScanner& scanner, const Token& token) {
    const std::string kind = scanner.string("a kind of light");
    const PbrtParameters parameters(scanner, token, scanner.parameters());
    const float scale = parameters.amount("scale", 1.0F);
    const glm::vec3 from = parameters.point("from", glm::vec3(0.0F));
    if (kind == "point") {
        scene_.lights.push_back({placed(scanner, token, from), scale * parameters.color("I").value_or(k_white)});
    } else if (kind == "distant") {
        const glm::vec3 back = from - parameters.point("to", {0.0F, 0.0F, 1.0F});
        const glm::dvec3 away = glm::dmat3(to_world_) * glm::dvec3(back);
        if (!(glm::length(away) > 0.0)) {
            scanner.fail(token, "`from` apart from `to`", "the same point");
        }
        scene_.lights.push_back(
            {k_sun_distance * glm::vec3(glm::normalize(away)), scale * parameters.color("L").value_or(k_white)});
    } else if (kind == "infinite" && parameters.find("filename") == nullptr) {
        scene_.background = scale * parameters.color("L").value_or(k_white);
    } else {
        scanner.fail(token, "a light of the kind \"point\" or \"distant\", or \"infinite\" of one colour",
                     raysteps::quoted(kind));
    }
}

// What pbrt would make brighter or darker by other parameters must not be taken for another light.
Color PbrtWorld::read_area_light(PbrtScanner& scanner, const Token& token) {
    if (scanner.string("a kind of area light") != "diffuse") {
        scanner.fail(token, "AreaLightSource \"diffuse\"", "another one");
    }
    const PbrtParameters parameters(scanner, token, scanner.parameters());
    for (const std::string_view other : {"filename", "power"}) {
        if (const PbrtParameter* found = parameters.find(other)) {
            scanner.fail(found->at, "a light of one colour, \"rgb L\" times `scale`", raysteps::quoted(other));
        }
    }
    if (parameters.string("twosided") == "true") {
        scanner.fail(token, "a light that shines to one side; two lights back to back shine to both",
                     "`twosided` that is true");
    }
    return parameters.amount("scale", 1.0F) * parameters.color("L").value_or(k_white);
}

// Shapes.

bool PbrtWorld::shines() const { return state_.emission != k_black; }

Fill PbrtWorld::fill() const {
    Fill found = state_.material.fill;
    found.emission = state_.emission;
    found.light = shines() ? static_cast<std::uint32_t>(scene_.area_lights.size()) : 0;  // the last one
    return found;
}

// Takes normals of the shape to those of the world.
glm::dmat3 PbrtWorld::for_normals() const { return glm::transpose(glm::inverse(glm::dmat3(to_world_))); }

// How much larger the shape becomes, where it is by so much in all of the first axes.
double PbrtWorld::size_of(const PbrtScanner& scanner, const Token& token, int axes, std::string_view expected) const {
    const glm::dmat3 transform(state_.transform);
    const double size = glm::length(transform[0]);
    for (int axis = 1; axis < axes; ++axis) {
        if (std::abs(glm::length(transform[axis]) - size) > 1e-4 * size) {
            scanner.fail(token, expected, "another scale");
        }
    }
    return size;
}

void PbrtWorld::check_untextured(const PbrtScanner& scanner, const Token& token, const std::string& kind) const {
    if (state_.material.texture) {
        scanner.fail(token, "a material without a texture for a " + kind, "one with a texture");
    }
}

void PbrtWorld::read_shape(PbrtScanner& scanner, const Token& token) {
    const std::string kind = scanner.string("a kind of shape");
    const PbrtParameters parameters(scanner, token, scanner.parameters());
    if (kind == "sphere") {
        add_sphere(scanner, parameters);
    } else if (kind == "disk") {
        add_disk(scanner, parameters);
    } else if (kind == "trianglemesh") {
        add_mesh(scanner, token, pbrt_mesh(scanner, parameters));
    } else if (kind == "plymesh") {
        add_mesh(scanner, token, read_ply(pbrt_path(folder_, scanner, token, parameters.string("filename"))));
    } else if (kind == "objmesh") {
        add_mesh(scanner, token, read_obj(pbrt_path(folder_, scanner, token, parameters.string("filename"))));
    } else {
        scanner.fail(token, "a shape of the kind \"trianglemesh\", \"plymesh\", \"objmesh\", \"sphere\" or \"disk\"",
                     raysteps::quoted(kind));
    }
}

void PbrtWorld::add_sphere(const PbrtScanner& scanner, const PbrtParameters& parameters) {
    const Token& token = parameters.directive();
    check_untextured(scanner, token, "sphere");
    const double size = size_of(scanner, token, 3, "a sphere that is scaled alike in all directions");
    const float radius = radius_of(scanner, parameters, size);
    const glm::vec3 center = placed(scanner, token, glm::vec3(0.0F));
    if (shines()) {
        if (state_.reversed) {
            scanner.fail(token, "a sphere that shines outwards", "`ReverseOrientation`");
        }
        scene_.area_lights.push_back({SphereLight{.center = center, .radius = radius}, state_.emission});
    }
    scene_.add(std::make_unique<Sphere>(center, radius, fill()));
}

void PbrtWorld::add_disk(const PbrtScanner& scanner, const PbrtParameters& parameters) {
    const Token& token = parameters.directive();
    check_untextured(scanner, token, "disk");
    if (parameters.number("innerradius", 0.0F) != 0.0F || parameters.number("phimax", 360.0F) != 360.0F) {
        scanner.fail(token, "a whole disk", "`innerradius` or `phimax`");
    }
    const std::string_view round = "a disk that stays round";
    const double size = size_of(scanner, token, 2, round);
    const glm::dmat3 transform(state_.transform);
    if (std::abs(glm::dot(transform[0], transform[1])) > 1e-4 * size * size) {
        scanner.fail(token, round, "another transformation");
    }
    const float radius = radius_of(scanner, parameters, size);
    const glm::vec3 center = placed(scanner, token, {0.0F, 0.0F, parameters.number("height", 0.0F)});
    const glm::vec3 upright(glm::normalize(for_normals()[2]));
    const glm::vec3 normal = state_.reversed ? -upright : upright;
    if (shines()) {
        scene_.area_lights.push_back(
            {DiskLight{.center = center, .normal = normal, .radius = radius}, state_.emission});
    }
    scene_.add(std::make_unique<Disk>(center, normal, radius, fill()));
}

void PbrtWorld::add_mesh(const PbrtScanner& scanner, const Token& token, const MeshData& mesh) {
    if (mesh.triangles.empty()) {
        scanner.fail(token, "a mesh with triangles", "none");
    }
    const glm::dmat3 turn = for_normals();
    std::vector<glm::vec3> positions;
    for (const glm::vec3& position : mesh.positions) {
        positions.push_back(placed(scanner, token, position));
    }
    for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
        const glm::vec3 flat = flat_normal(mesh, triangle);
        MeshFace face;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t corner = triangle.at(i);
            const bool has_normal = !mesh.normals.empty() && mesh.normals[corner] != glm::vec3(0.0F);
            const glm::dvec3 normal = turn * glm::dvec3(has_normal ? mesh.normals[corner] : flat);
            face.at(i).position = positions[corner];
            face.at(i).normal = glm::length(normal) > 0.0 ? glm::vec3(glm::normalize(normal)) : glm::vec3(0.0F);
            face.at(i).uv = place_in_texture(mesh.uvs.empty() ? glm::vec2(i == 1, i == 2) : mesh.uvs[corner]);
        }
        if (shines()) {
            light_up(face);
        }
        scene_.add(std::make_unique<MeshTriangle>(face, fill(),
                                                  state_.material.texture ? state_.material.texture->texture
                                                                          : std::shared_ptr<const MeshTexture>()));
    }
}

// The bright side is that of the corners' normals, as in pbrt, and becomes the front.
void PbrtWorld::light_up(MeshFace& face) {
    const auto corner = [&](std::size_t i) { return face.at(i).position; };
    const glm::vec3 front = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    glm::vec3 bright(0.0F);
    for (const MeshCorner& one : face) {
        bright += one.normal;
    }
    if ((glm::dot(front, bright) < 0.0F) != state_.reversed) {
        std::swap(face[1], face[2]);
    }
    if (glm::dot(front, front) > 0.0F) {
        scene_.area_lights.push_back({TriangleLight{corner(0), corner(1), corner(2)}, state_.emission});
    }
}

// In files v goes up, and in the kit it goes down.
glm::vec2 PbrtWorld::place_in_texture(const glm::vec2& uv) const {
    if (!state_.material.texture) {
        return uv;
    }
    const glm::vec2 place = uv * state_.material.texture->scale + state_.material.texture->shift;
    return {place.x, 1.0F - place.y};
}

glm::vec3 PbrtWorld::placed(const PbrtScanner& scanner, const Token& token, const glm::vec3& point) const {
    const glm::vec3 found(to_world_ * glm::dvec4(point, 1.0));
    require_near(scanner, token, found);
    return found;
}

}  // namespace raysteps
