// The live figures by themselves, as the handouts on the site have them: no tests, no pictures of whole scenes.
#include "figures.hpp"

int main(int argc, char** argv) { return raysteps::figure_main(argc, argv); }
