"""What the judge gives to a function: numbers for the worker's line, and words for people.

The order of the numbers is that of framework/worker/protocol.hpp.
"""

import math
import struct
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from typing import NoReturn, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from raysteps.common.vectors import Vector, add, dot

# Numbers as the worker knows them: float32, in the shortest text that names it. What is computed with vectors before
# that is in double precision.

Number: TypeAlias = float | int
Numbers: TypeAlias = NDArray[np.float64]

_pack, _unpack = struct.Struct("f").pack, struct.Struct("f").unpack
_pack_vector, _unpack_vector = struct.Struct("3f").pack, struct.Struct("3f").unpack


def f32(value: float) -> float:
    """The nearest float32."""
    nearest: float = _unpack(_pack(value))[0]
    return nearest


def text(value: Number) -> str:
    """Read back by the worker it is the same float32."""
    if value == 0:  # which equals the zero of the other sign
        return "-0" if math.copysign(1, value) < 0 else "0"
    return _text(value)


@lru_cache(maxsize=1 << 14, typed=True)  # most numbers of scenes are multiples of 1 / 64
def _text(value: Number) -> str:
    return str(value) if isinstance(value, int) else str(np.float32(value)).removesuffix(".0")


def rounded(v: Vector) -> Vector:
    """Each component as the nearest float32."""
    x, y, z = _unpack_vector(_pack_vector(*v))
    return x, y, z


def mirrored(direction: Vector, normal: Vector) -> Vector:
    return add(direction, normal, -2 * dot(direction, normal))


# What stands in a case.


class Value(Protocol):
    """One input."""

    def numbers(self) -> list[Number]: ...

    def words(self) -> str: ...


Inputs: TypeAlias = Mapping[str, Value]


def vector_words(v: Vector) -> str:
    return f"({text(v[0])}, {text(v[1])}, {text(v[2])})"


@dataclass(frozen=True)
class Real:
    """A single number."""

    value: float

    def numbers(self) -> list[Number]:
        return [self.value]

    def words(self) -> str:
        return text(self.value)


@dataclass(frozen=True)
class Whole:
    """A whole number."""

    value: int

    def numbers(self) -> list[Number]:
        return [self.value]

    def words(self) -> str:
        return str(self.value)


@dataclass(frozen=True)
class Vec:
    """A point, a direction or a colour."""

    value: Vector

    def numbers(self) -> list[Number]:
        return list(self.value)

    def words(self) -> str:
        return vector_words(self.value)


def real_of(inputs: Inputs, name: str) -> float:
    """A single number of a case."""
    value = inputs[name]
    assert isinstance(value, Real)
    return value.value


def whole_of(inputs: Inputs, name: str) -> int:
    """A whole number of a case."""
    value = inputs[name]
    assert isinstance(value, Whole)
    return value.value


def vec_of(inputs: Inputs, name: str) -> Vector:
    """A point, a direction or a colour of a case."""
    value = inputs[name]
    assert isinstance(value, Vec)
    return value.value


@dataclass(frozen=True)
class Ray:
    origin: Vector
    direction: Vector

    def numbers(self) -> list[Number]:
        return [*self.origin, *self.direction]

    def words(self) -> str:
        return f"from {vector_words(self.origin)} towards {vector_words(self.direction)}"


@dataclass(frozen=True)
class Camera:
    origin: Vector
    at: Vector
    up: Vector
    angle: float
    width: int
    height: int
    lens: Vector = (0.0, 0.0, 1.0)  # hither, lens_radius and focal_distance: none of them matters to step 01

    def numbers(self) -> list[Number]:
        return [*self.origin, *self.at, *self.up, self.angle, self.width, self.height, *self.lens]

    def words(self) -> str:
        hither, radius, focus = self.lens
        lens = f" hither {text(hither)} lens_radius {text(radius)} focal_distance {text(focus)}" if hither else ""
        return (
            f"from {vector_words(self.origin)} at {vector_words(self.at)} up {vector_words(self.up)} "
            f"angle {text(self.angle)} resolution {self.width} {self.height}{lens}"
        )


@dataclass(frozen=True)
class Frame:
    """The view frame of step 01."""

    right: Vector
    up: Vector
    forward: Vector
    half_width: float
    half_height: float

    def numbers(self) -> list[Number]:
        return [*self.right, *self.up, *self.forward, self.half_width, self.half_height]

    def words(self) -> str:
        return (
            f"right {vector_words(self.right)} up {vector_words(self.up)} forward {vector_words(self.forward)} "
            f"half_width {text(self.half_width)} half_height {text(self.half_height)}"
        )


@dataclass(frozen=True)
class Fill:
    color: Vector = (1.0, 1.0, 1.0)
    kd: float = 1.0
    ks: float = 0.0
    shine: float = 1.0
    transmittance: float = 0.0
    index: float = 1.0

    def numbers(self) -> list[Number]:
        return [*self.color, self.kd, self.ks, self.shine, self.transmittance, self.index]

    def words(self) -> str:
        return (
            f"colour {vector_words(self.color)} kd {text(self.kd)} ks {text(self.ks)} shine {text(self.shine)} "
            f"transmittance {text(self.transmittance)} index {text(self.index)}"
        )


@dataclass(frozen=True)
class Light:
    position: Vector
    color: Vector = (1.0, 1.0, 1.0)

    def numbers(self) -> list[Number]:
        return [*self.position, *self.color]

    def words(self) -> str:
        return f"at {vector_words(self.position)} colour {vector_words(self.color)}"


@dataclass(frozen=True)
class Lights:
    lights: tuple[Light, ...]

    def numbers(self) -> list[Number]:
        return [len(self.lights), *(number for light in self.lights for number in light.numbers())]

    def words(self) -> str:
        return "; ".join(light.words() for light in self.lights) or "none"


@dataclass(frozen=True)
class PixelSample:
    """Offset from the pixel's middle, and light."""

    offset: tuple[float, float]
    light: Vector

    def numbers(self) -> list[Number]:
        return [*self.offset, *self.light]

    def words(self) -> str:
        return f"offset ({text(self.offset[0])}, {text(self.offset[1])}) light {vector_words(self.light)}"


@dataclass(frozen=True)
class PixelSamples:
    samples: tuple[PixelSample, ...]

    def numbers(self) -> list[Number]:
        return [len(self.samples), *(number for sample in self.samples for number in sample.numbers())]

    def words(self) -> str:
        return "; ".join(sample.words() for sample in self.samples) or "none"


@dataclass(frozen=True)
class Vec2:
    """A place in a texture, or its size."""

    value: tuple[float, float]

    def numbers(self) -> list[Number]:
        return list(self.value)

    def words(self) -> str:
        return f"({text(self.value[0])}, {text(self.value[1])})"


@dataclass(frozen=True)
class Corner:
    position: Vector
    normal: Vector
    uv: tuple[float, float] = (0.0, 0.0)

    def numbers(self) -> list[Number]:
        return [*self.position, *self.normal, *self.uv]

    def words(self) -> str:
        return f"position {vector_words(self.position)} normal {vector_words(self.normal)} uv {Vec2(self.uv).words()}"


@dataclass(frozen=True)
class Face:
    """A triangle of a mesh."""

    a: Corner
    b: Corner
    c: Corner

    def numbers(self) -> list[Number]:
        return [*self.a.numbers(), *self.b.numbers(), *self.c.numbers()]

    def words(self) -> str:
        return "; ".join(corner.words() for corner in (self.a, self.b, self.c))


@dataclass(frozen=True)
class Texture:
    """Its colours, row by row."""

    width: int
    texels: tuple[Vector, ...]

    @property
    def height(self) -> int:
        return len(self.texels) // self.width

    def numbers(self) -> list[Number]:
        return [self.width, self.height, *(number for texel in self.texels for number in texel)]

    def words(self) -> str:
        return f"{self.width} x {self.height}: " + " ".join(vector_words(texel) for texel in self.texels)


@dataclass(frozen=True)
class Pyramid:
    levels: tuple[Texture, ...]

    def numbers(self) -> list[Number]:
        return [len(self.levels), *(number for level in self.levels for number in level.numbers())]

    def words(self) -> str:
        return "; ".join(level.words() for level in self.levels)


@dataclass(frozen=True)
class Hit:
    """A hit record."""

    position: Vector
    normal: Vector
    ray_direction: Vector
    distance: float = 1.0
    fill: Fill = Fill()
    front_face: bool = True

    def numbers(self) -> list[Number]:
        return [
            *self.position,
            *self.fill.numbers(),
            *self.normal,
            *self.ray_direction,
            self.distance,
            int(self.front_face),
        ]

    def words(self) -> str:
        return (
            f"position {vector_words(self.position)} normal {vector_words(self.normal)} "
            f"ray_direction {vector_words(self.ray_direction)} distance {text(self.distance)} "
            f"front_face {str(self.front_face).lower()} fill: {self.fill.words()}"
        )


@dataclass(frozen=True)
class Box:
    low: Vector
    high: Vector

    def numbers(self) -> list[Number]:
        return [*self.low, *self.high]

    def words(self) -> str:
        return f"{vector_words(self.low)} to {vector_words(self.high)}"


# Reads the words of an answer. They come from a student's process: anything may stand there.

_MAX_DIGITS = 40
_FLAGS = ("0", "1")
_MAX_CHARACTERS = 2_000_000  # of a line; the largest tree is half as long


class ProtocolError(Exception):
    """An answer that does not have the form that the worker writes."""


class TokenReader:
    """The words of one answer, from left to right."""

    def __init__(self, line: str) -> None:
        if len(line) > _MAX_CHARACTERS:
            raise ProtocolError("the answer is too long")
        self._words = line.split()
        self._next = 0

    def _take(self, size: int) -> list[str]:
        found = self._words[self._next : self._next + size]
        if len(found) < size:
            raise ProtocolError("the answer is too short")
        self._next += size
        return found

    def word(self) -> str:
        if self._next >= len(self._words):
            raise ProtocolError("the answer is too short")
        self._next += 1
        return self._words[self._next - 1]

    def real(self) -> float:
        """The float32 that was written: its shortest decimal text is another number where floats are 64 bits wide."""
        found = self.word()
        try:
            return f32(float(found)) if len(found) <= _MAX_DIGITS else _refuse()
        except (ValueError, OverflowError):
            return _refuse()

    def whole(self, low: int = 0, high: int = 1 << 31) -> int:
        return self.wholes(1, low, high)[0]

    def wholes(self, size: int, low: int, high: int) -> tuple[int, ...]:
        """Many at once."""
        found = self._take(size)
        try:
            numbers = tuple(int(word) if len(word) <= _MAX_DIGITS else low - 1 for word in found)
        except ValueError:
            raise ProtocolError("the answer holds a word where a whole number belongs") from None
        if numbers and not low <= min(numbers) <= max(numbers) <= high:
            raise ProtocolError("the answer holds a number out of range")
        return numbers

    def flag(self) -> bool:
        return self.whole(0, 1) == 1

    def vector(self) -> Vector:
        found = self._words[self._next : self._next + 3]
        if len(found) == 3 and max(map(len, found)) <= _MAX_DIGITS:
            with suppress(ValueError, OverflowError):
                vector = rounded((float(found[0]), float(found[1]), float(found[2])))
                self._next += 3
                return vector
        return self.real(), self.real(), self.real()  # one of which says what is wrong

    def reals(self, size: int) -> Numbers:
        """Many at once."""
        return _reals(self._take(size))

    def rows(self, width: int, most: int) -> Numbers:
        """All that is left, so many numbers in each row; what comes after `most` rows stays."""
        left = len(self._words) - self._next
        return self.reals(width * min(-(-left // width), most)).reshape(-1, width)

    def optional_rows(self, width: int, most: int) -> tuple[list[bool], Numbers]:
        """The same, with a 1 before each row, and a 0 in place of one that is not there: which are, then those."""
        found: list[str] = []
        there: list[bool] = []
        words, at = self._words, self._next
        while at < len(words) and len(there) < most:
            if words[at] not in _FLAGS:
                return _refuse()
            there.append(words[at] == "1")
            if there[-1]:
                found += words[at + 1 : at + 1 + width]
                at += width
            at += 1
        if at > len(words):
            raise ProtocolError("the answer is too short")
        self._next = at
        return there, _reals(found).reshape(-1, width)

    def at_end(self) -> bool:
        return self._next == len(self._words)

    def end(self) -> None:
        if not self.at_end():
            raise ProtocolError("the answer is too long")


def _reals(words: list[str]) -> Numbers:
    """As `TokenReader.real` reads each of them."""
    if max(map(len, words), default=0) > _MAX_DIGITS:
        return _refuse()
    try:
        with np.errstate(over="ignore"):
            numbers = np.fromiter(map(float, words), np.float64, len(words))
            return numbers.astype(np.float32).astype(np.float64)
    except ValueError:
        return _refuse()


def _refuse() -> NoReturn:
    raise ProtocolError("the answer holds a word where a number belongs")
