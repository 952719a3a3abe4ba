#pragma once
// The live figures of the handouts, as a program.

namespace raysteps {

/// The words are `figure`, the name of one, and its numbers. Prints what the functions of the steps say, as JSON.
int figure_main(int argc, char** argv);

}  // namespace raysteps
