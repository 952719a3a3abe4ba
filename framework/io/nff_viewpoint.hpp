#pragma once
// The `v` entity of NFF.
#include "core/camera.hpp"
#include "io/token_scanner.hpp"

namespace raysteps {

/// Reads what follows `v`: from, at, up and angle, and if given hither and resolution, in any order.
/// `entity` is the `v` itself, the place of errors about the whole. Throws ReadError.
[[nodiscard]] Camera read_viewpoint(TokenScanner& scanner, const Token& entity);

}  // namespace raysteps
