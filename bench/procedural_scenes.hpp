#pragma once
// Scenes of any number of surfaces. The same kind and number give the same scene.
#include <string>

#include "core/scene.hpp"

namespace raysteps::bench {

/// About `count` surfaces, one light, no mirrors. Throws UsageError for an unknown kind. The kinds:
/// - cloud: triangles anywhere in a cube, as large as the distance between them
/// - clusters: spheres in clusters of clusters; what they cover together is the same for any number
/// - dust: triangles anywhere in a cube; what they cover together is the same for any number
/// - terrain: one hilly sheet of triangles
[[nodiscard]] Scene make_scene(const std::string& kind, int count);

}  // namespace raysteps::bench
