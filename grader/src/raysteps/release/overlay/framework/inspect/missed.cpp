// Only the whole kit searches again for what a step lost: that search is what steps 02 and 06 are about.
#include "inspect/missed.hpp"

namespace raysteps {

std::optional<Missed> find_missed(const RayNode& /*node*/, float /*limit*/, const SurfaceList& /*surfaces*/,
                                  const Accelerator& /*accelerator*/, const Recorder& /*recorder*/) {
    return std::nullopt;
}

}  // namespace raysteps
