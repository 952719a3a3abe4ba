// Directions and paths: step 13.
#include "steps/13-path-tracing/path_tracing.hpp"
#include "worker/draws.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"
#include "worker/scripted_path.hpp"

namespace raysteps {
namespace {

void ask_cosine_direction(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 normal = words.vector();
    for (const auto& direction : draw_often(words, [&](const glm::vec2& u) { return cosine_direction(normal, u); })) {
        answer.vector(direction);
    }
}

void ask_cosine_pdf(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 normal = words.vector();
    answer.number(cosine_pdf(normal, words.vector()));
}

void ask_scatter_diffuse(TokenReader& words, TokenWriter& answer) {
    HitRecord hit = read_hit(words);
    hit.fill.emission = words.vector();
    for (const auto& sample : draw_often(words, [&](const glm::vec2& u) { return scatter_diffuse(hit, u); })) {
        write_sample(answer, sample);
    }
}

void ask_survival_probability(TokenReader& words, TokenWriter& answer) {
    answer.number(survival_probability(words.vector()));
}

void ask_path_light(TokenReader& words, TokenWriter& answer) {
    const Ray ray = read_ray(words);
    const PathScript script = read_path_script(words);
    answer_path(script, read_estimate_plan(words), answer,
                [&](ScriptedPath& tracer, RandomStream& random) { return path_light(tracer, ray, random); });
}

}  // namespace

void add_paths(FunctionTable& functions) {
    functions["cosine_direction"] = ask_cosine_direction;
    functions["cosine_pdf"] = ask_cosine_pdf;
    functions["scatter_diffuse"] = ask_scatter_diffuse;
    functions["survival_probability"] = ask_survival_probability;
    functions["path_light"] = ask_path_light;
}

}  // namespace raysteps
