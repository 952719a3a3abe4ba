#pragma once
// The functions of all steps by their names in the manifests.
#include <map>
#include <string_view>

#include "worker/protocol.hpp"

namespace raysteps {

/// Reads the inputs, asks the function, and writes what it returned.
using Function = void (*)(TokenReader&, TokenWriter&);
using FunctionTable = std::map<std::string_view, Function>;

void add_intersections(FunctionTable& functions);
void add_light(FunctionTable& functions);
void add_trees(FunctionTable& functions);
void add_sampling(FunctionTable& functions);
void add_meshes(FunctionTable& functions);
void add_soft_light(FunctionTable& functions);
void add_paths(FunctionTable& functions);
void add_materials(FunctionTable& functions);

/// For solutions/NN-name/worker.cpp of a step that the kit does not know: offers a function before main begins. Always
/// true.
bool offer_function(std::string_view name, Function function);

/// Asks the function of that name. Throws ProtocolError where there is none.
void answer_case(std::string_view function, TokenReader& words, TokenWriter& answer);

}  // namespace raysteps
