// Only the whole kit searches again for what a step lost: that search is what steps 02 and 06 are about.
#include "inspect/lost_hit.hpp"

namespace raysteps {

std::optional<LostHit> find_lost_hit(const RayNode& /*node*/, float /*limit*/, const SurfaceList& /*surfaces*/,
                                     const Accelerator& /*accelerator*/, const SearchRecorder& /*recorder*/) {
    return std::nullopt;
}

}  // namespace raysteps
