#pragma once
// Numbers of a live figure that are drawn, not read.
#include <cmath>
#include <initializer_list>

#include "io/json_writer.hpp"

namespace raysteps {

/// Numbers that are only drawn, as an array: nine digits take a fifth of the time that the shortest text takes in the
/// page, whose C++ library has no std::to_chars for them.
inline void write_drawn(JsonWriter& json, std::initializer_list<float> numbers) {
    json.begin_array();
    for (const float number : numbers) {
        if (std::isfinite(number)) {
            json.number(static_cast<double>(number));
        } else {
            json.number(number);
        }
    }
    json.end_array();
}

}  // namespace raysteps
