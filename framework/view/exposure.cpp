#include "view/exposure.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

float exposure_factor(float stops) { return std::exp2(stops); }

float round_stops(float stops) { return std::round(10.0F * std::clamp(stops, -k_most_stops, k_most_stops)) / 10.0F; }

float slider_place(float stops) { return 0.5F + 0.5F * stops / k_most_stops; }

float stops_at(float place) { return round_stops((2.0F * place - 1.0F) * k_most_stops); }

}  // namespace raysteps
