#pragma once
// What several measurements of the same thing say.
#include <vector>

#include "io/json_writer.hpp"

namespace raysteps::bench {

struct Spread {
    double median = 0.0;
    double least = 0.0;
    double most = 0.0;
    double lower_quartile = 0.0;
    double upper_quartile = 0.0;
};

/// At least one value.
[[nodiscard]] Spread spread_of(std::vector<double> values);

void write(JsonWriter& json, const std::vector<double>& values);

}  // namespace raysteps::bench
