#pragma once
// One ray and all that follow from it, as JSON.
#include "inspect/pixel_record.hpp"
#include "io/json_writer.hpp"

namespace raysteps {

void write_counts(JsonWriter& json, const SearchCounts& counts);
void write_ray(JsonWriter& json, const RayNode& node);

}  // namespace raysteps
