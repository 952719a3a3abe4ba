"""Cases of step 03."""

from raysteps.judge.generators.phong_diffuse import DIFFUSE
from raysteps.judge.generators.phong_mirror import MIRROR
from raysteps.judge.generators.phong_shade import SHADE
from raysteps.judge.generators.phong_specular import SPECULAR

FUNCTIONS = (MIRROR, DIFFUSE, SPECULAR, SHADE)
