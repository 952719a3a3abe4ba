#include "render/any_hit.hpp"

namespace raysteps {

bool any_hit(const SurfaceList& surfaces, const Ray& ray, float distance) {
    return any_hit_here(surfaces, ray, distance);
}

}  // namespace raysteps
