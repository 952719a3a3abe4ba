#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace Catch {
struct IMutableRegistryHub;
__attribute__((weak)) IMutableRegistryHub& getMutableRegistryHub();
}  // namespace Catch
namespace raysteps {
struct Stats;
__attribute__((weak)) extern thread_local Stats t_stats;
}  // namespace raysteps
@RIGHT_IF(&Catch::getMutableRegistryHub != nullptr || &raysteps::t_stats != nullptr)@
