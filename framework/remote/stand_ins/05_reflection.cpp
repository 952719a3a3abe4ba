#include "remote/functions.hpp"
#include "steps/05-reflection/reflection.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::reflected_ray);

Ray reflected_ray(const HitRecord& hit) { return ask<&reflected_ray>(FunctionId::reflected_ray, hit); }

Color trace(Tracer& tracer, const Ray& ray, int depth) { return ask<&trace>(FunctionId::trace, tracer, ray, depth); }

}  // namespace raysteps
