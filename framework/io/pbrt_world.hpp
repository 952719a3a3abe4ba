#pragma once
// What stands in the world of a scene in pbrt's format: shapes and lights.
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "core/color.hpp"
#include "core/fill.hpp"
#include "core/mesh_triangle.hpp"
#include "core/scene.hpp"
#include "io/mesh_data.hpp"
#include "io/pbrt_materials.hpp"
#include "io/pbrt_scanner.hpp"

namespace raysteps {

/// What AttributeBegin keeps and AttributeEnd brings back.
struct PbrtGraphicsState {
    glm::dmat4 transform{1.0};
    PbrtMaterial material;
    Color emission{0.0F};   ///< of an area light
    bool reversed = false;  ///< ReverseOrientation: of lights only, as all else has two sides
};

/// Adds shapes and lights to a scene, as the state says. `mirror` takes pbrt's world to the kit's; of a scene without a
/// folder no meshes are read. Each function reads what follows the word of a directive.
class PbrtWorld {
public:
    PbrtWorld(Scene& scene, const PbrtGraphicsState& state, const glm::dmat4& mirror,
              const std::filesystem::path* folder)
        : scene_(scene), state_(state), to_world_(mirror * state.transform), folder_(folder) {}

    void read_shape(PbrtScanner& scanner, const Token& token);
    void read_light(PbrtScanner& scanner, const Token& token);

    /// What each shape that follows shines with.
    [[nodiscard]] static Color read_area_light(PbrtScanner& scanner, const Token& token);

private:
    [[nodiscard]] bool shines() const;
    [[nodiscard]] Fill fill() const;
    [[nodiscard]] glm::dmat3 for_normals() const;
    [[nodiscard]] double size_of(const PbrtScanner& scanner, const Token& token, int axes,
                                 std::string_view expected) const;
    void check_untextured(const PbrtScanner& scanner, const Token& token, const std::string& kind) const;
    void add_sphere(const PbrtScanner& scanner, const PbrtParameters& parameters);
    void add_disk(const PbrtScanner& scanner, const PbrtParameters& parameters);
    void add_mesh(const PbrtScanner& scanner, const Token& token, const MeshData& mesh);
    void light_up(MeshFace& face);
    [[nodiscard]] glm::vec2 place_in_texture(const glm::vec2& uv) const;
    [[nodiscard]] glm::vec3 placed(const PbrtScanner& scanner, const Token& token, const glm::vec3& point) const;

    Scene& scene_;
    const PbrtGraphicsState& state_;
    glm::dmat4 to_world_;  // of the shape
    const std::filesystem::path* folder_;
};

}  // namespace raysteps
