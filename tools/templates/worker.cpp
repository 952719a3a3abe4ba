// How the judge's worker asks the functions of step @NUMBER@: it reads what judge.py draws, in the same order.
#include "steps/@ID@/@FILE@.hpp"
#include "worker/functions.hpp"

namespace raysteps {
namespace {

void ask_@FILE@_color(TokenReader& words, TokenWriter& answer) {
    const Color color = words.vector();
    answer.vector(@FILE@_color(color, words.number()));
}

[[maybe_unused]] const bool k_offered = offer_function("@FILE@_color", ask_@FILE@_color);

}  // namespace
}  // namespace raysteps
