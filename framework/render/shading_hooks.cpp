#include "render/shading_hooks.hpp"

#include <map>

#include "render/integrator.hpp"

namespace raysteps {
namespace {

std::map<int, ShadingHook>& registered() {
    static std::map<int, ShadingHook> hooks;
    return hooks;
}

}  // namespace

bool register_shading_hook(int step, ShadingHook hook) {
    registered()[step] = hook;
    return true;
}

Color apply_shading_hooks(Tracer& tracer, const Ray& ray, const Color& color, int step) {
    Color seen = color;
    for (const auto& [own_step, hook] : registered()) {
        if (own_step <= step && is_of_part_two(own_step) == is_of_part_two(step)) {
            seen = hook(tracer, ray, seen);
        }
    }
    return seen;
}

}  // namespace raysteps
