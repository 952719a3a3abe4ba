// Mirrors, glass and rough metal: step 14.
#include <cstddef>
#include <cstdint>

#include "core/random_stream.hpp"
#include "core/threads.hpp"
#include "steps/14-materials/materials.hpp"
#include "worker/draws.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"

namespace raysteps {
namespace {

/// A hit, and how rough it is.
HitRecord read_rough_hit(TokenReader& words) {
    HitRecord hit = read_hit(words);
    hit.fill.roughness = words.number();
    return hit;
}

void ask_fresnel_dielectric(TokenReader& words, TokenWriter& answer) {
    const float cosine = words.number();
    answer.number(fresnel_dielectric(cosine, words.number()));
}

void ask_fresnel_schlick(TokenReader& words, TokenWriter& answer) {
    const Color f0 = words.vector();
    answer.vector(fresnel_schlick(f0, words.number()));
}

void ask_scatter_mirror(TokenReader& words, TokenWriter& answer) {
    write_sample(answer, scatter_mirror(read_hit(words)));
}

void ask_ggx_distribution(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 normal = words.vector();
    answer.number(ggx_distribution(normal, words.number()));
}

void ask_ggx_lambda(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 direction = words.vector();
    answer.number(ggx_lambda(direction, words.number()));
}

void ask_sample_visible_normal(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 view = words.vector();
    const float alpha = words.number();
    const auto draw = [&](const glm::vec2& u) { return sample_visible_normal(view, alpha, u); };
    for (const glm::vec3& normal : draw_often(words, draw)) {
        answer.vector(normal);
    }
}

void ask_visible_normal_pdf(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 view = words.vector();
    const glm::vec3 normal = words.vector();
    answer.number(visible_normal_pdf(view, normal, words.number()));
}

void ask_metal_brdf(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 view = words.vector();
    const glm::vec3 light = words.vector();
    const Color f0 = words.vector();
    answer.vector(metal_brdf(view, light, f0, words.number()));
}

void ask_metal_pdf(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 view = words.vector();
    const glm::vec3 light = words.vector();
    answer.number(metal_pdf(view, light, words.number()));
}

void ask_scatter_metal(TokenReader& words, TokenWriter& answer) {
    const HitRecord hit = read_rough_hit(words);
    for (const auto& sample : draw_often(words, [&](const glm::vec2& u) { return scatter_metal(hit, u); })) {
        write_sample(answer, sample);
    }
}

void ask_scatter_glass(TokenReader& words, TokenWriter& answer) {
    const HitRecord hit = read_rough_hit(words);
    const auto draw = [&](RandomStream& random) { return scatter_glass(hit, random); };
    for (const auto& sample : draw_with_streams(words, draw)) {
        write_sample(answer, sample);
    }
}

}  // namespace

void add_materials(FunctionTable& functions) {
    functions["fresnel_dielectric"] = ask_fresnel_dielectric;
    functions["fresnel_schlick"] = ask_fresnel_schlick;
    functions["scatter_mirror"] = ask_scatter_mirror;
    functions["ggx_distribution"] = ask_ggx_distribution;
    functions["ggx_lambda"] = ask_ggx_lambda;
    functions["sample_visible_normal"] = ask_sample_visible_normal;
    functions["visible_normal_pdf"] = ask_visible_normal_pdf;
    functions["metal_brdf"] = ask_metal_brdf;
    functions["metal_pdf"] = ask_metal_pdf;
    functions["scatter_metal"] = ask_scatter_metal;
    functions["scatter_glass"] = ask_scatter_glass;
}

}  // namespace raysteps
