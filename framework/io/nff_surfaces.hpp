#pragma once
// The entities of NFF that can be seen: `s`, `c`, `p` and `pp`.
#include "core/scene.hpp"
#include "io/token_scanner.hpp"

namespace raysteps {

/// Each reads what follows its entity's letter and adds the surfaces to the scene. They throw ReadError.
void read_sphere(TokenScanner& scanner, const Fill& fill, Scene& scene);   ///< `s`
void read_cone(TokenScanner& scanner, const Fill& fill, Scene& scene);     ///< `c`
void read_polygon(TokenScanner& scanner, const Fill& fill, Scene& scene);  ///< `p`: triangles
void read_patch(TokenScanner& scanner, const Fill& fill, Scene& scene);    ///< `pp`: smooth triangles

}  // namespace raysteps
