// Light and its ways: steps 03, 04, 05, 07 and 08.
#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"
#include "steps/05-reflection/reflection.hpp"
#include "steps/07-tone-mapping/tone_mapping.hpp"
#include "steps/08-refraction/refraction.hpp"
#include "worker/counting_surfaces.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"
#include "worker/scripted_tracer.hpp"

namespace raysteps {
namespace {

void ask_mirror(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 direction = words.vector();
    answer.vector(mirror(direction, words.vector()));
}

void ask_diffuse(TokenReader& words, TokenWriter& answer) {
    const Fill fill = read_fill(words);
    const Light light = read_light(words);
    const glm::vec3 normal = words.vector();
    answer.vector(diffuse(fill, light, normal, words.vector()));
}

void ask_specular(TokenReader& words, TokenWriter& answer) {
    const Fill fill = read_fill(words);
    const Light light = read_light(words);
    const glm::vec3 normal = words.vector();
    const glm::vec3 to_light = words.vector();
    answer.vector(specular(fill, light, normal, to_light, words.vector()));
}

void ask_shade(TokenReader& words, TokenWriter& answer) {
    const HitRecord hit = read_hit(words);
    answer.vector(shade(hit, read_lights(words)));
}

void ask_shadow_ray(TokenReader& words, TokenWriter& answer) {
    const HitRecord hit = read_hit(words);
    write_ray(answer, shadow_ray(hit, read_light(words)));
}

void ask_is_lit(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const Scene scene = read_surfaces(words, asked);
    const HitRecord hit = read_hit(words);
    const Light light = read_light(words);
    const ListQuery list(scene.surfaces());
    std::uint64_t rays = 0;
    answer.flag(is_lit(CountingQuery(list, rays), hit, light));
    answer.whole(static_cast<long long>(rays));
}

void ask_reflected_ray(TokenReader& words, TokenWriter& answer) { write_ray(answer, reflected_ray(read_hit(words))); }

Script read_script(TokenReader& words) {
    Script script;
    script.max_depth = words.whole();
    script.background = words.vector();
    for (int left = words.count(); left > 0; --left) {
        ScriptedHit hit;
        hit.distance = words.number();
        hit.normal = words.vector();
        hit.ks = words.number();
        hit.local = words.vector();
        script.hits.push_back(hit);
    }
    return script;
}

// The colour, the rays that were cast, and the hits that were shaded, each with its depth.
void ask_trace(TokenReader& words, TokenWriter& answer) {
    const Ray ray = read_ray(words);
    const int depth = words.whole();
    TracerCalls calls;
    ScriptedTracer tracer(read_script(words), calls);
    answer.vector(trace(tracer, ray, depth));
    answer.whole(static_cast<long long>(calls.cast.size()));
    for (const Ray& cast : calls.cast) {
        write_ray(answer, cast);
    }
    answer.whole(static_cast<long long>(calls.shaded.size()));
    for (const ShadedHit& shaded : calls.shaded) {
        answer.number(shaded.distance).whole(shaded.depth);
    }
}

void ask_tone_map(TokenReader& words, TokenWriter& answer) { answer.vector(tone_map(words.vector())); }

void ask_to_byte(TokenReader& words, TokenWriter& answer) { answer.whole(to_byte(words.number())); }

void ask_refract(TokenReader& words, TokenWriter& answer) {
    const glm::vec3 direction = words.vector();
    const glm::vec3 normal = words.vector();
    const std::optional<glm::vec3> refracted = refract(direction, normal, words.number());
    if (!refracted) {
        answer.word("none");
        return;
    }
    answer.word("direction").vector(*refracted);
}

void ask_transmitted_ray(TokenReader& words, TokenWriter& answer) {
    write_ray(answer, transmitted_ray(read_hit(words)));
}

// The colour, and the rays that were traced, each with its depth.
void ask_transmitted_light(TokenReader& words, TokenWriter& answer) {
    const HitRecord hit = read_hit(words);
    const int depth = words.whole();
    Script script;
    script.max_depth = words.whole();
    script.traced = words.vector();
    script.background = {0.25F, 0.5F, 0.75F};  // neither this nor the glass's own light comes through it
    script.own_light = {0.5F, 0.25F, 0.5F};
    TracerCalls calls;
    ScriptedTracer tracer(script, calls);
    answer.vector(transmitted_light(tracer, hit, depth));
    answer.whole(static_cast<long long>(calls.traced.size()));
    for (const CastRay& traced : calls.traced) {
        write_ray(answer, traced.ray);
        answer.whole(traced.depth);
    }
}

}  // namespace

void add_light(FunctionTable& functions) {
    functions["mirror"] = ask_mirror;
    functions["diffuse"] = ask_diffuse;
    functions["specular"] = ask_specular;
    functions["shade"] = ask_shade;
    functions["shadow_ray"] = ask_shadow_ray;
    functions["is_lit"] = ask_is_lit;
    functions["reflected_ray"] = ask_reflected_ray;
    functions["trace"] = ask_trace;
    functions["tone_map"] = ask_tone_map;
    functions["to_byte"] = ask_to_byte;
    functions["refract"] = ask_refract;
    functions["transmitted_ray"] = ask_transmitted_ray;
    functions["transmitted_light"] = ask_transmitted_light;
}

}  // namespace raysteps
