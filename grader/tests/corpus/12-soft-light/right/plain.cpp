#include "steps/12-soft-light/soft_light.hpp"
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
using namespace std;
using namespace glm;
namespace raysteps {
vec3 turned_to(const vec3& normal, const vec3& vector) {
    vec3 helper = fabs(normal.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    vec3 s = normalize(cross(helper, normal));
    vec3 t = cross(normal, s);
    return mat3(s, t, normal) * vector;
}
vec2 unit_disk(const vec2& u) {
    // two sectors by rejection are not allowed, so polar
    float phi = two_pi<float>() * u.y, r = pow(u.x, 0.5f);
    return vec2(sin(phi), cos(phi)) * r;
}
vec3 cap_direction(float height, const vec2& u) {
    float down = height * (1.0f - u.y);
    float r = sqrt(fmax(0.0f, down * (2.0f - down)));
    float phi = two_pi<float>() * u.x;
    return vec3(r * cos(phi), r * sin(phi), 1.0f - down);
}
float solid_angle_pdf(float area_pdf, const vec3& from, const vec3& position, const vec3& normal) {
    vec3 back = from - position;
    float dist2 = dot(back, back);
    if (dist2 == 0) return 0;
    float cosine = dot(normal, normalize(back));
    if (cosine <= 0) return 0;
    return area_pdf * dist2 / cosine;
}
LightSample sample_triangle(const TriangleLight& light, const vec3& from, const vec2& u) {
    float r = sqrt(1.0f - u.x);
    float wa = 1 - r, wb = r * (1 - u.y), wc = r * u.y;
    LightSample s;
    s.position = wa * light.a + wb * light.b + wc * light.c;
    vec3 n = cross(light.b - light.a, light.c - light.a);
    s.normal = normalize(n);
    s.pdf = solid_angle_pdf(2.0f / length(n), from, s.position, s.normal);
    return s;
}
LightSample sample_disk(const DiskLight& light, const vec3& from, const vec2& u) {
    LightSample s;
    vec2 d = unit_disk(u);
    s.position = light.center + turned_to(light.normal, vec3(d * light.radius, 0));
    s.normal = light.normal;
    s.pdf = solid_angle_pdf(one_over_pi<float>() / (light.radius * light.radius), from, s.position, s.normal);
    return s;
}
LightSample sample_sphere(const SphereLight& light, const vec3& from, const vec2& u) {
    vec3 axis = light.center - from;
    float d = length(axis);
    if (d <= light.radius) return LightSample{light.center, vec3(0, 0, 1), 0};
    float sin2 = (light.radius / d) * (light.radius / d);
    float height = sin2 / (1 + sqrt(1 - sin2));
    vec3 local = cap_direction(height, u);
    vec3 dir = turned_to(axis / d, local);
    float sine2 = local.x * local.x + local.y * local.y;
    float t = d * local.z - sqrt(fmax(0.0f, light.radius * light.radius - d * d * sine2));
    LightSample s;
    s.normal = normalize(from + t * dir - light.center);
    s.position = light.center + light.radius * s.normal;
    s.pdf = 1 / (two_pi<float>() * height);
    return s;
}
Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    vec3 l = normalize(sample.position - hit.position);
    float c = dot(l, hit.normal);
    if (c <= 0 || sample.pdf <= 0) return k_black;
    vec3 f = hit.fill.kd * hit.fill.color / pi<float>();
    return radiance * f * c / sample.pdf;
}
Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const vec2& u) {
    vec2 d = unit_disk(u);
    vec3 off = camera.lens_radius * (d.x * frame.right + d.y * frame.up);
    vec3 focus = ray.direction * (camera.focal_distance / dot(ray.direction, frame.forward));
    return Ray{camera.from + off, normalize(focus - off)};
}
}
