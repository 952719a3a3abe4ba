#pragma once
// What an instructor's own steps make of a picture: fog, outlines, a softer camera.
#include "core/tracer.hpp"

namespace raysteps {

/// From the colour of a primary ray to the colour that is shown, before tone mapping.
using PictureOf = Color (*)(Tracer& tracer, const Ray& ray, const Color& color);

/// CMake calls it for each manifest that says `picture = "function"`, before main begins. Always true.
bool offer_picture(int step, PictureOf picture);

/// What the steps up to this one make of the colour, one after the other.
[[nodiscard]] Color with_own_pictures(Tracer& tracer, const Ray& ray, const Color& color, int step);

}  // namespace raysteps
