// NDC -> screen -> camera -> world, as on Scratchapixel
#include "steps/01-camera-rays/camera_rays.hpp"
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

static inline float deg2rad(const float& deg) { return deg * 3.14159265358979F / 180.0F; }

glm::vec3 point_at(const Ray& ray, float distance)
{
    glm::vec3 p;
    p.x = ray.origin.x + ray.direction.x * distance;
    p.y = ray.origin.y + ray.direction.y * distance;
    p.z = ray.origin.z + ray.direction.z * distance;
    return p;
}

ViewFrame view_frame(const Camera& camera)
{
    float imageAspectRatio = camera.width / (float)camera.height;
    float scale = tanf(deg2rad(camera.angle * 0.5F));

    ViewFrame frame;
    frame.half_height = scale;
    frame.half_width = scale * imageAspectRatio;

    glm::vec3 dir = camera.at - camera.from;
    dir /= glm::length(dir);
    glm::vec3 side = glm::cross(dir, camera.up);
    side /= glm::length(side);
    frame.forward = dir;
    frame.right = side;
    frame.up = glm::cross(side, dir);
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y)
{
    float ndcX = (x + 0.5F) / camera.width;
    float ndcY = (y + 0.5F) / camera.height;
    float screenX = 2.0F * ndcX - 1.0F;
    float screenY = 1.0F - 2.0F * ndcY;
    float camX = screenX * frame.half_width;
    float camY = screenY * frame.half_height;

    Ray ray;
    ray.origin = camera.from;
    ray.direction = frame.right * camX + frame.up * camY + frame.forward;
    ray.direction = glm::normalize(ray.direction);
    return ray;
}

}
