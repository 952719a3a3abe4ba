"""Cases of step 07."""

import math

from raysteps.common.vectors import Vector
from raysteps.judge.answers import (
    Answer,
    Tolerance,
    channels,
    itself,
    plainly_wrong,
    read_vector,
    read_whole,
    words_of_number,
    words_of_vector,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Inputs, Real, Vec, f32
from raysteps.judge.random_source import RandomSource

_CLOSE = Tolerance(1e-5, 1e-4)
_COLOR = Answer(read_vector, words_of_vector, lambda _, e, a: channels("the colour", e, a, _CLOSE), near=itself)


def _byte_problem(_inputs: Inputs, expected: int, actual: int) -> str:
    return "" if expected == actual else plainly_wrong("the byte")


def _one_of(draw: RandomSource, odd: tuple[float, ...]) -> Vector:
    """One or more channels are odd, the others ordinary."""
    channel = draw.whole(0, 2)
    picked = [
        odd[draw.whole(0, len(odd) - 1)] if i == channel or draw.chance(0.3) else draw.real(0.1, 4) for i in range(3)
    ]
    return picked[0], picked[1], picked[2]


def _color(value: Vector) -> Inputs:
    return {"color": Vec(value)}


def _known(draw: RandomSource) -> Inputs:
    values = (0.0, 0.25, 1.0, 3.0, 9.0)
    return _color(_each_one_of(draw, values))


def _each_one_of(draw: RandomSource, values: tuple[float, ...]) -> Vector:
    """Each channel one of the values, not all 0."""

    def one() -> float:
        return values[draw.whole(0, len(values) - 1)]

    return draw.until(lambda rgb: sum(rgb) > 0, lambda: (one(), one(), one()))


_INFINITE = (math.inf,)
_NO_COLOR = (-1.0, -0.5, -100.0, -math.inf, math.nan, -0.0)


def _channel(draw: RandomSource) -> float:
    """Well away from the border between two bytes."""
    return f32((draw.whole(1, 254) + draw.real(-0.4, 0.4)) / 255)


def _byte(value: float) -> Inputs:
    return {"channel": Real(value)}


def _simple_byte(draw: RandomSource) -> Inputs:
    return _byte((0.2, 0.25, 0.4, 0.6, 0.75, 0.8)[draw.whole(0, 5)])


def _rounded_up(draw: RandomSource) -> Inputs:
    """Nearer to the next byte: cutting off gives one too few. A quarter lie at one of the ends."""
    byte = draw.whole(1, 254) if draw.chance(0.75) else (1, 2, 253, 254)[draw.whole(0, 3)]
    return _byte(f32((byte - draw.real(0.1, 0.4)) / 255))


def _odd_byte(draw: RandomSource) -> Inputs:
    return _byte((*_NO_COLOR, f32(-1e30))[draw.whole(0, 6)])


def _bright_byte(draw: RandomSource) -> Inputs:
    return _byte((1.0, f32(1.1), 2.0, 300.0, f32(1e30), math.inf)[draw.whole(0, 5)])


def _beside_step(draw: RandomSource) -> Inputs:
    """A little below or above the border between two bytes, ten times as far as float errs and more."""
    return _byte(f32((draw.whole(0, 254) + 0.5 + draw.sign() * draw.logarithmic(0.0005, 0.05)) / 255))


_LARGEST = 3.4028234663852886e38
_ENDS = (_LARGEST, f32(1e35), f32(1e-35), f32(1e-40))

FUNCTIONS = (
    Function(
        "tone_map",
        _COLOR,
        (
            Group("any colour", lambda d: _color((d.real(0.05, 8), d.real(0.05, 8), d.real(0.05, 8)))),
            Group("known values", _known, exact=True),
            Group("very bright", lambda d: _color((d.real(100, 1e4), d.real(1e4, 1e6), f32(1e30)))),
            Group("very dark", lambda d: _color((d.real(0, 0.01), d.real(0, 0.01), d.real(0, 0.01)))),
            Group("infinite", lambda d: _color(_one_of(d, _INFINITE))),
            Group("the ends of float", lambda d: _color(_one_of(d, _ENDS)), exact=True),
            Group("negative or NaN", lambda d: _color(_one_of(d, _NO_COLOR)), exact=True),
        ),
    ),
    Function(
        "to_byte",
        Answer(read_whole, words_of_number, _byte_problem),
        (
            Group("any level", lambda d: _byte(_channel(d))),
            Group("simple numbers", _simple_byte),
            Group("rounded up", _rounded_up),
            Group("close to the next level", _beside_step),
            Group("the ends of float", lambda d: _byte(_ENDS[d.whole(0, 3)]), exact=True),
            Group("1 and brighter", _bright_byte),
            Group("negative or NaN", _odd_byte, exact=True),
        ),
    ),
)
