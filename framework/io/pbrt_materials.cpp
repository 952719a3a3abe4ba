#include "io/pbrt_materials.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include "io/files.hpp"
#include "io/texture_reader.hpp"

namespace raysteps {
namespace {

/// What a polished metal mirrors straight on, in linear sRGB.
struct NamedMetal {
    std::string_view symbol;
    Color color;
};
const std::array<NamedMetal, 4> k_metals{{{"Ag", {0.97F, 0.96F, 0.91F}},
                                          {"Al", {0.91F, 0.92F, 0.92F}},
                                          {"Au", {1.0F, 0.77F, 0.34F}},
                                          {"Cu", {0.95F, 0.64F, 0.54F}}}};

/// Squares of two colours; a texture of two by two of them is enough.
Texture checkerboard(const Color& first, const Color& second) {
    constexpr int k_square = 32;
    Texture texture{.width = 2 * k_square, .height = 2 * k_square, .texels = {}};
    for (int y = 0; y < texture.height; ++y) {
        for (int x = 0; x < texture.width; ++x) {
            texture.texels.push_back((x < k_square) == (y >= k_square) ? first : second);
        }
    }
    return texture;
}

// By default pbrt's roughness is the square of GGX's. What is nearly smooth is smooth, as there.
float roughness_of(const PbrtParameters& parameters) {
    const float roughness = parameters.share("roughness", 0.0F);
    const float alpha = parameters.string("remaproughness") != "false" ? std::sqrt(roughness) : roughness;
    return alpha < 1e-3F ? 0.0F : alpha;
}

float index_of(const PbrtScanner& scanner, const PbrtParameters& parameters) {
    const float index = parameters.number("eta", 1.5F);
    if (!(index >= 1.0F && index <= 4.0F)) {
        scanner.fail(parameters.directive(), "`eta` from 1 to 4", "another one");
    }
    return index;
}

// What comes back straight on is a colour, `reflectance`, or that of a metal by name.
void read_metal(const PbrtScanner& scanner, const PbrtParameters& parameters, Fill& fill) {
    fill.roughness = roughness_of(parameters);
    fill.scattering = fill.roughness > 0.0F ? Scattering::metal : Scattering::mirror;
    if (parameters.find("reflectance") != nullptr) {
        fill.color = parameters.color("reflectance").value_or(k_white);
        return;
    }
    const std::string eta = parameters.string("eta");
    const std::string name = eta.empty() ? "metal-Cu-eta" : eta;  // copper, as in pbrt
    for (const NamedMetal& metal : k_metals) {
        if (name == "metal-" + std::string(metal.symbol) + "-eta") {
            fill.color = metal.color;
            return;
        }
    }
    scanner.fail(parameters.directive(), "`rgb reflectance`, or `spectrum eta` of \"metal-Ag-eta\", Al, Au or Cu",
                 raysteps::quoted(name));
}

}  // namespace

void PbrtMaterials::name_texture(PbrtScanner& scanner, const Token& token) {
    const std::string name = scanner.string("a name");
    static_cast<void>(scanner.string("`spectrum` or `float`"));
    textures_[name] = texture(scanner, token);
}

void PbrtMaterials::name_material(PbrtScanner& scanner, const Token& token) {
    const std::string name = scanner.string("a name");
    const PbrtParameters parameters(scanner, token, scanner.parameters());
    materials_[name] = material(scanner, parameters, parameters.string("type"));
}

PbrtMaterial PbrtMaterials::read_material(PbrtScanner& scanner, const Token& token) const {
    const std::string kind = scanner.string("a kind of material");
    const PbrtParameters parameters(scanner, token, scanner.parameters());
    return material(scanner, parameters, kind);
}

const PbrtMaterial& PbrtMaterials::named_material(PbrtScanner& scanner, const Token& token) const {
    const auto found = materials_.find(scanner.string("the name of a material"));
    if (found == materials_.end()) {
        scanner.fail(token, "a material that was named before", "another one");
    }
    return found->second;
}

PbrtTexture PbrtMaterials::texture(PbrtScanner& scanner, const Token& token) const {
    const std::string kind = scanner.string("a kind of texture");
    const PbrtParameters parameters(scanner, token, scanner.parameters());
    PbrtTexture found;
    found.scale = {parameters.number("uscale", 1.0F), parameters.number("vscale", 1.0F)};
    found.shift = {parameters.number("udelta", 0.0F), parameters.number("vdelta", 0.0F)};
    if (kind == "checkerboard") {
        const Color first = parameters.color("tex1").value_or(k_white);
        const Color second = parameters.color("tex2").value_or(k_black);
        found.texture = std::make_shared<MeshTexture>(MeshTexture{checkerboard(first, second), Wrap::repeat});
        found.scale *= 0.5F;
        found.shift *= 0.5F;
    } else if (kind == "imagemap") {
        const bool linear = parameters.string("encoding") == "linear";
        const bool clamp = parameters.string("wrap") == "clamp";
        found.texture = std::make_shared<MeshTexture>(MeshTexture{
            picture(scanner, token, parameters.string("filename"), linear), clamp ? Wrap::clamp : Wrap::repeat});
    } else {
        scanner.fail(token, "a texture of the kind \"imagemap\" or \"checkerboard\"", raysteps::quoted(kind));
    }
    return found;
}

// A file, or, as in glTF, a picture that stands in the scene itself.
Texture PbrtMaterials::picture(const PbrtScanner& scanner, const Token& token, const std::string& file,
                               bool linear) const {
    if (!file.starts_with("data:")) {
        return read_texture(pbrt_path(folder_, scanner, token, file), linear);
    }
    const std::optional<std::string> bytes = bytes_of_data_uri(file);
    if (!bytes) {
        scanner.fail(token, "a file, or `data:image/png;base64,` and a whole picture in padded base64",
                     raysteps::quoted(file));
    }
    return read_texture(*bytes, scanner.place_of(token) + ": " + raysteps::quoted(file), linear);
}

// "phong" is the kit's own: part one's fill.
PbrtMaterial PbrtMaterials::material(const PbrtScanner& scanner, const PbrtParameters& parameters,
                                     const std::string& kind) const {
    PbrtMaterial found;
    if (kind == "phong" || kind == "coateddiffuse") {
        const bool coated = kind == "coateddiffuse";
        found.fill.ks = coated ? 0.1F : parameters.share("ks", 0.3F);
        found.fill.shine = coated ? 60.0F : parameters.amount("shine", 30.0F);
    } else if (kind == "conductor") {
        read_metal(scanner, parameters, found.fill);
        return found;
    } else if (kind == "dielectric") {
        found.fill.color = k_white;
        found.fill.scattering = Scattering::glass;
        found.fill.index_of_refraction = index_of(scanner, parameters);
        found.fill.roughness = roughness_of(parameters);
        return found;
    } else if (kind != "diffuse") {
        scanner.fail(parameters.directive(),
                     "a material of the kind \"diffuse\", \"coateddiffuse\", \"conductor\", \"dielectric\" or "
                     "\"phong\"",
                     raysteps::quoted(kind));
    }
    const PbrtParameter* reflectance = parameters.find("reflectance");
    if (reflectance != nullptr && reflectance->type == "texture") {
        const auto texture = textures_.find(parameters.string("reflectance"));
        if (texture == textures_.end()) {
            scanner.fail(reflectance->at, "a texture that was named before", "another one");
        }
        found.texture = texture->second;
        found.fill.color = k_white;
    } else {
        found.fill.color = parameters.color("reflectance").value_or(found.fill.color);
    }
    return found;
}

}  // namespace raysteps
