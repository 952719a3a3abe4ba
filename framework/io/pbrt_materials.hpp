#pragma once
// Textures and materials of a scene in pbrt's format.
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/fill.hpp"
#include "core/mesh_triangle.hpp"
#include "io/pbrt_scanner.hpp"

namespace raysteps {

/// What a texture is, and how often it goes into the unit square.
struct PbrtTexture {
    std::shared_ptr<const MeshTexture> texture;
    glm::vec2 scale{1.0F};
    glm::vec2 shift{0.0F};
};

struct PbrtMaterial {
    Fill fill{.color = Color(0.5F)};
    std::optional<PbrtTexture> texture;
};

/// What a scene says of textures and materials, and those that it named. Each function reads what follows the word of
/// a directive.
class PbrtMaterials {
public:
    /// Of a scene without a folder no pictures are read.
    explicit PbrtMaterials(const std::filesystem::path* folder) : folder_(folder) {}

    /// `Texture` and `MakeNamedMaterial`.
    void name_texture(PbrtScanner& scanner, const Token& token);
    void name_material(PbrtScanner& scanner, const Token& token);

    /// `Material` and `NamedMaterial`.
    [[nodiscard]] PbrtMaterial read_material(PbrtScanner& scanner, const Token& token) const;
    [[nodiscard]] const PbrtMaterial& named_material(PbrtScanner& scanner, const Token& token) const;

private:
    [[nodiscard]] PbrtTexture texture(PbrtScanner& scanner, const Token& token) const;
    [[nodiscard]] Texture picture(const PbrtScanner& scanner, const Token& token, const std::string& file,
                                  bool linear) const;
    [[nodiscard]] PbrtMaterial material(const PbrtScanner& scanner, const PbrtParameters& parameters,
                                        const std::string& kind) const;

    const std::filesystem::path* folder_;
    std::map<std::string, PbrtTexture> textures_;
    std::map<std::string, PbrtMaterial> materials_;
};

}  // namespace raysteps
