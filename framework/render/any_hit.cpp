#include "render/any_hit.hpp"

namespace raysteps {

bool any_hit(const SurfaceList& surfaces, const Ray& ray, float distance) {
    return test_until_hit(surfaces, ray, distance);
}

}  // namespace raysteps
