#include "steps/03-phong-shading/phong_shading.hpp"
#include <cmath>

namespace raysteps {

// a . b
static double dotp(const glm::vec3& a, const glm::vec3& b)
{
    double s = 0;
    for (int i = 0; i < 3; i++) s += (double)a[i] * b[i];
    return s;
}

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal)
{
    double k = dotp(direction, normal);
    glm::vec3 result;
    for (int i = 0; i < 3; i++) result[i] = (float)(direction[i] - 2 * k * normal[i]);
    return result;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light)
{
    double cosine = dotp(normal, to_light);
    if (cosine < 0) cosine = 0;
    Color c;
    c.r = (float)(fill.kd * cosine * fill.color.r * light.color.r);
    c.g = (float)(fill.kd * cosine * fill.color.g * light.color.g);
    c.b = (float)(fill.kd * cosine * fill.color.b * light.color.b);
    return c;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye)
{
    if (dotp(normal, to_light) <= 0) return k_black;
    glm::vec3 minus_l(-to_light.x, -to_light.y, -to_light.z);
    double cosine = dotp(mirror(minus_l, normal), to_eye);
    if (cosine < 0) cosine = 0;
    double share = fill.ks * pow(cosine, fill.shine);
    Color c;
    c.r = (float)(share * light.color.r);
    c.g = (float)(share * light.color.g);
    c.b = (float)(share * light.color.b);
    return c;
}

Color shade(const HitRecord& hit, std::span<const Light> lights)
{
    Color sum(0, 0, 0);
    glm::vec3 to_eye(-hit.ray_direction.x, -hit.ray_direction.y, -hit.ray_direction.z);
    for (auto it = lights.begin(); it != lights.end(); ++it) {
        glm::vec3 way = it->position - hit.position;
        double length = sqrt(dotp(way, way));
        glm::vec3 to_light((float)(way.x / length), (float)(way.y / length), (float)(way.z / length));
        Color d = diffuse(hit.fill, *it, hit.normal, to_light);
        Color s = specular(hit.fill, *it, hit.normal, to_light, to_eye);
        sum.r += d.r + s.r;
        sum.g += d.g + s.g;
        sum.b += d.b + s.b;
    }
    return sum;
}

}
