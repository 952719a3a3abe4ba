"""What the cases of step 03 share: colours as answers, and simple lights and surfaces."""

from raysteps.judge.answers import Answer, read_vector, words_of_vector
from raysteps.judge.comparing import channels
from raysteps.judge.drawing import Draw
from raysteps.judge.generators.axes import next_axis
from raysteps.judge.numbers import Vector, add, rounded, times
from raysteps.judge.values import Fill, Light

COLOR = Answer(read_vector, words_of_vector, lambda _, e, a: channels("the colour", e, a))
WHITE = Light((0.0, 0.0, 10.0))
PLAIN = Fill((1.0, 1.0, 1.0), 1.0, 1.0, 1.0)


def simple_normals(draw: Draw) -> tuple[Vector, Vector]:
    """An axis, and a direction to the light with a cosine of 1 or 0.8."""
    normal = draw.axis()
    if draw.chance(0.4):
        return normal, normal
    side = times(draw.sign(), next_axis(normal))
    return normal, rounded(add(times(0.8, normal), side, 0.6))
