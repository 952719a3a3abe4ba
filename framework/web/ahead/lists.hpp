#pragma once
// What somebody who builds a tree does with lists. It is compiled with the headers of a step, once, so that no save has
// to make the same functions of std::vector again: a sixth of the compiler's time. Nobody calls what is here.
#include <vector>

#include "core/surface.hpp"

namespace raysteps::compiled_ahead {

template <typename List>
void use_list(List& list) {
    list.emplace_back();
    list.push_back(list.back());
    list.reserve(1);
    list.resize(1);
    list.clear();
    list = List(list);
    list = List(1);
}

inline void use_lists(SurfaceList& surfaces, std::vector<float>& numbers) {
    use_list(surfaces);
    use_list(numbers);
}

}  // namespace raysteps::compiled_ahead
