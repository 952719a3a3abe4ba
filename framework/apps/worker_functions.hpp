#pragma once
// The functions of all steps by their names in the manifests.
#include <string_view>

#include "apps/worker_words.hpp"

namespace raysteps {

/// Reads the inputs, asks the function, and writes what it returned. Throws BadCase for an unknown function.
void answer_case(std::string_view function, Words& words, Answer& answer);

}  // namespace raysteps
