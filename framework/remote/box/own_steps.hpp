#pragma once
// Which steps in the box are the student's.

namespace raysteps::remote {

/// Whether step 02 is one of them.
[[nodiscard]] bool has_own_intersections();

}  // namespace raysteps::remote
