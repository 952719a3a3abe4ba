#include "worker/functions.hpp"

namespace raysteps {
namespace {

FunctionTable& offered() {
    static FunctionTable functions;
    return functions;
}

FunctionTable all_functions() {
    FunctionTable functions = offered();
    add_intersections(functions);
    add_light(functions);
    add_trees(functions);
    add_sampling(functions);
    add_meshes(functions);
    add_soft_light(functions);
    add_paths(functions);
    add_materials(functions);
    return functions;
}

}  // namespace

bool offer_function(std::string_view name, Function function) {
    offered()[name] = function;
    return true;
}

void answer_case(std::string_view function, TokenReader& words, TokenWriter& answer) {
    static const FunctionTable functions = all_functions();
    const auto found = functions.find(function);
    if (found == functions.end()) {
        throw ProtocolError("there is no function " + std::string(function));
    }
    found->second(words, answer);
    words.expect_end();
}

}  // namespace raysteps
