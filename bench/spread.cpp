#include "bench/spread.hpp"

#include <algorithm>
#include <cstddef>

namespace raysteps::bench {
namespace {

/// Between the two neighbours in rank; share from 0 to 1.
double quantile(const std::vector<double>& sorted, double share) {
    const double rank = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.5), values.front(), values.back(), quantile(values, 0.25), quantile(values, 0.75)};
}

void write(JsonWriter& json, const std::vector<double>& values) {
    const Spread spread = spread_of(values);
    json.begin_object(JsonWriter::Layout::block).key("median").number(spread.median).key("min").number(spread.least);
    json.key("max").number(spread.most).key("q1").number(spread.lower_quartile);
    json.key("q3").number(spread.upper_quartile).key("rounds").begin_array(JsonWriter::Layout::block);
    for (const double value : values) {
        json.number(value);
    }
    json.end_array().end_object();
}

}  // namespace raysteps::bench
