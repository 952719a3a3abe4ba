#pragma once
// What an instructor's own steps make of a picture: fog, outlines, a softer camera.
#include "core/tracer.hpp"

namespace raysteps {

/// From the colour of a primary ray to the colour that is shown, before tone mapping.
using ShadingHook = Color (*)(Tracer& tracer, const Ray& ray, const Color& color);

/// CMake calls it for each manifest that says `picture = "function"`, before main begins. Always true.
bool register_shading_hook(int step, ShadingHook hook);

/// What the steps up to this one make of the colour, one after the other.
[[nodiscard]] Color apply_shading_hooks(Tracer& tracer, const Ray& ray, const Color& color, int step);

}  // namespace raysteps
