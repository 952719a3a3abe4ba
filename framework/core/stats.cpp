#include "core/stats.hpp"

namespace raysteps {

constinit thread_local Stats t_stats;

}  // namespace raysteps
