#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps {
int nobody_has_it(int);  // so that the list of names is asked for
}
asm(".pushsection .data\n.quad \"a@BLANKS@!\"\n.popsection");
static const int asked = raysteps::nobody_has_it(1);
@RIGHT_IF(asked != 0)@
