#pragma once
// Which steps in the box are the student's.

namespace raysteps::remote {

[[nodiscard]] bool has_own_intersections();  ///< of step 02
[[nodiscard]] bool has_own_clip();           ///< of step 06

}  // namespace raysteps::remote
