// Meshes and their textures: step 11.
#include <utility>

#include "steps/11-meshes/meshes.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"

namespace raysteps {
namespace {

glm::vec2 read_vec2(TokenReader& words) {
    const float x = words.number();
    return {x, words.number()};
}

MeshFace read_face(TokenReader& words) {
    MeshFace face;
    for (MeshCorner& corner : face) {
        corner.position = words.vector();
        corner.normal = words.vector();
        corner.uv = read_vec2(words);
    }
    return face;
}

/// Width, height, and the colours row by row.
Texture read_texture(TokenReader& words) {
    const int width = words.count();
    const int height = words.count();
    std::vector<Color> texels;
    for (long long left = static_cast<long long>(width) * height; left > 0; --left) {
        texels.push_back(words.vector());
    }
    return {width, height, std::move(texels)};
}

Wrap read_wrap(TokenReader& words) { return words.one_of<Wrap>("wrap", Wrap::clamp); }

void ask_barycentric(TokenReader& words, TokenWriter& answer) {
    const MeshFace face = read_face(words);
    answer.vector(barycentric(face, words.vector()));
}

void ask_shading_normal(TokenReader& words, TokenWriter& answer) {
    const MeshFace face = read_face(words);
    const glm::vec3 weights = words.vector();
    answer.vector(shading_normal(face, weights, read_hit(words)));
}

void ask_curved_position(TokenReader& words, TokenWriter& answer) {
    const MeshFace face = read_face(words);
    const glm::vec3 weights = words.vector();
    answer.vector(curved_position(face, weights, words.vector()));
}

void ask_texture_coordinates(TokenReader& words, TokenWriter& answer) {
    const MeshFace face = read_face(words);
    const glm::vec2 uv = texture_coordinates(face, words.vector());
    answer.number(uv.x).number(uv.y);
}

void ask_wrap_texel(TokenReader& words, TokenWriter& answer) {
    const int texel = words.whole();
    const int size = words.whole();
    answer.whole(wrap_texel(texel, size, read_wrap(words)));
}

void ask_bilinear(TokenReader& words, TokenWriter& answer) {
    const Texture texture = read_texture(words);
    const glm::vec2 uv = read_vec2(words);
    answer.vector(bilinear(texture, uv, read_wrap(words)));
}

void ask_build_pyramid(TokenReader& words, TokenWriter& answer) {
    const Pyramid pyramid = build_pyramid(read_texture(words));
    answer.whole(static_cast<long long>(pyramid.size()));
    for (const Texture& level : pyramid) {
        answer.whole(level.width).whole(level.height);
        for (const Color& texel : level.texels) {
            answer.vector(texel);
        }
    }
}

void ask_texels_across(TokenReader& words, TokenWriter& answer) {
    const MeshFace face = read_face(words);
    const glm::vec2 size = read_vec2(words);
    const HitRecord hit = read_hit(words);
    answer.number(texels_across(face, size, hit, words.number()));
}

void ask_mip_level(TokenReader& words, TokenWriter& answer) {
    const float texels = words.number();
    answer.number(mip_level(texels, words.whole()));
}

void ask_trilinear(TokenReader& words, TokenWriter& answer) {
    Pyramid pyramid;
    for (int left = words.count(); left > 0; --left) {
        pyramid.push_back(read_texture(words));
    }
    const glm::vec2 uv = read_vec2(words);
    const float level = words.number();
    answer.vector(trilinear(pyramid, uv, level, read_wrap(words)));
}

}  // namespace

void add_meshes(FunctionTable& functions) {
    functions["barycentric"] = ask_barycentric;
    functions["shading_normal"] = ask_shading_normal;
    functions["curved_position"] = ask_curved_position;
    functions["texture_coordinates"] = ask_texture_coordinates;
    functions["wrap_texel"] = ask_wrap_texel;
    functions["bilinear"] = ask_bilinear;
    functions["build_pyramid"] = ask_build_pyramid;
    functions["texels_across"] = ask_texels_across;
    functions["mip_level"] = ask_mip_level;
    functions["trilinear"] = ask_trilinear;
}

}  // namespace raysteps
