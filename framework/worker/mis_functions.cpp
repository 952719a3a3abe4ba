// Two ways to a lamp: step 15.
#include "steps/15-mis/mis.hpp"
#include "worker/functions.hpp"
#include "worker/scripted_path.hpp"

namespace raysteps {
namespace {

void ask_balance_heuristic(TokenReader& words, TokenWriter& answer) {
    const float pdf = words.number();
    answer.number(balance_heuristic(pdf, words.number()));
}

void ask_power_heuristic(TokenReader& words, TokenWriter& answer) {
    const float pdf = words.number();
    answer.number(power_heuristic(pdf, words.number()));
}

void ask_triangle_pdf(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 a = words.vector();
    const glm::vec3 b = words.vector();
    const TriangleLight light{a, b, words.vector()};
    const glm::vec3 from = words.vector();
    answer.number(triangle_pdf(light, from, words.vector()));
}

void ask_disk_pdf(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 center = words.vector();
    const glm::vec3 normal = words.vector();
    const DiskLight light{center, normal, words.number()};
    const glm::vec3 from = words.vector();
    answer.number(disk_pdf(light, from, words.vector()));
}

void ask_sphere_pdf(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 center = words.vector();
    const SphereLight light{center, words.number()};
    answer.number(sphere_pdf(light, words.vector()));
}

void ask_direct_light(TokenReader& words, TokenWriter& answer) { answer.vector(direct_light(read_samples(words))); }

void ask_emission_weight(TokenReader& words, TokenWriter& answer) {
    ScatterSample sample = read_scatter(words);
    sample.pdf = words.number();
    answer.number(emission_weight(sample, words.number()));
}

void ask_mis_path_light(TokenReader& words, TokenWriter& answer) {
    const Ray ray = read_ray(words);
    const PathScript script = read_mis_script(words);
    answer_path(script, read_estimate_plan(words), answer,
                [&](ScriptedPath& tracer, RandomStream& random) { return mis_path_light(tracer, ray, random); });
}

}  // namespace

void add_mis(FunctionTable& functions) {
    functions["balance_heuristic"] = ask_balance_heuristic;
    functions["power_heuristic"] = ask_power_heuristic;
    functions["triangle_pdf"] = ask_triangle_pdf;
    functions["disk_pdf"] = ask_disk_pdf;
    functions["sphere_pdf"] = ask_sphere_pdf;
    functions["direct_light"] = ask_direct_light;
    functions["emission_weight"] = ask_emission_weight;
    functions["mis_path_light"] = ask_mis_path_light;
}

}  // namespace raysteps
