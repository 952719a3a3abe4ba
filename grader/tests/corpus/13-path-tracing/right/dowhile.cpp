#include "steps/13-path-tracing/path_tracing.hpp"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
using namespace std;
using namespace glm;
namespace raysteps {
vec3 cosine_direction(const vec3& normal, const vec2& u) {
    float theta = 0.5f * acos(glm::clamp(1.0f - 2.0f * u.x, -1.0f, 1.0f));
    float phi = two_pi<float>() * u.y;
    vec3 a = abs(normal.z) > 0.9f ? vec3(0, 1, 0) : vec3(0, 0, 1);
    vec3 t = normalize(cross(a, normal)), b = cross(normal, t);
    return normalize(sin(theta) * (cos(phi) * t + sin(phi) * b) + cos(theta) * normal);
}
float cosine_pdf(const vec3& normal, const vec3& direction) {
    float c = dot(normal, direction);
    return c <= 0 ? 0 : c * one_over_pi<float>();
}
optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const vec2& u) {
    vec3 rho = hit.fill.kd * hit.fill.color;
    if (rho.x <= 0 && rho.y <= 0 && rho.z <= 0) return nullopt;
    ScatterSample s;
    s.direction = cosine_direction(hit.normal, u);
    s.pdf = cosine_pdf(hit.normal, s.direction);
    s.specular = false;
    float c = dot(hit.normal, s.direction);
    if (s.pdf > 1e-7f) s.weight = rho / pi<float>() * c / s.pdf; else s.weight = rho;
    return s;
}
float survival_probability(const Color& weight) {
    float q = 0;
    for (int i = 0; i < 3; i++) if (weight[i] > q) q = weight[i];
    return q > k_max_survival ? k_max_survival : q;
}
Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    Color light = k_black, T = k_white;
    Ray r = ray;
    bool countLamp = true;
    int n = 0;
    do {
        optional<HitRecord> hit = tracer.closest_hit(r);
        if (!hit) { light += T * tracer.background(); return light; }
        if (countLamp) light += T * emitted_light(*hit);
        light += T * tracer.light_sample(*hit);
        optional<ScatterSample> s = tracer.scatter(*hit);
        if (!s) return light;
        T *= s->weight;
        if (n + 1 > k_sure_bounces) {
            float q = survival_probability(T);
            float xi = random.next();
            if (xi > 1 - q || q <= 0) {} 
            if (q <= 0) return light;
            if (xi < 1 - q) return light;
            T = T / q;
        }
        countLamp = s->specular;
        r = scattered_ray(*hit, *s);
        n++;
    } while (true);
}
}
