#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace Catch {
struct IMutableRegistryHub {
    virtual ~IMutableRegistryHub() = default;
};
IMutableRegistryHub& getMutableRegistryHub();
void cleanUp();
}  // namespace Catch

static bool attack() {
    Catch::cleanUp();
    return &Catch::getMutableRegistryHub() != nullptr;
}
static const bool result = attack();
@RIGHT_IF(result)@
