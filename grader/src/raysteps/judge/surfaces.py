"""Surfaces as the judge gives them to a function, alone or in a list."""

from dataclasses import dataclass

from raysteps.judge.numbers import Number, Vector, add, minus, text
from raysteps.judge.values import Fill, vector_words

_MOST_IN_WORDS = 12


@dataclass(frozen=True)
class Sphere:
    center: Vector
    radius: float
    fill: Fill | None = None  # in a list the worker gives out the fills
    glass: bool = False  # in a list: lets light pass

    def numbers(self) -> list[Number]:
        return [*self.center, self.radius, *(self.fill.numbers() if self.fill else [])]

    def words(self) -> str:
        fill = f" {self.fill.words()}" if self.fill else ""
        return f"{'glass ' * self.glass}sphere at {vector_words(self.center)} radius {text(self.radius)}{fill}"


@dataclass(frozen=True)
class Triangle:
    a: Vector
    b: Vector
    c: Vector
    fill: Fill | None = None

    def numbers(self) -> list[Number]:
        return [*self.a, *self.b, *self.c, *(self.fill.numbers() if self.fill else [])]

    def at(self, u: float, v: float) -> Vector:
        """The point a + u (b - a) + v (c - a)."""
        return add(add(self.a, minus(self.b, self.a), u), minus(self.c, self.a), v)

    def words(self) -> str:
        fill = f" {self.fill.words()}" if self.fill else ""
        return f"triangle {vector_words(self.a)} {vector_words(self.b)} {vector_words(self.c)}{fill}"


@dataclass(frozen=True)
class Scripted:
    """A surface that every ray hits at one distance, or none hits."""

    distance: float | None

    def numbers(self) -> list[Number]:
        return [] if self.distance is None else [self.distance]

    def words(self) -> str:
        return "a surface that is missed" if self.distance is None else f"a surface hit at {text(self.distance)}"


Surface = Sphere | Triangle | Scripted


def _kind(surface: Surface) -> int:
    if isinstance(surface, Sphere):
        return 4 if surface.glass else 0
    if isinstance(surface, Triangle):
        return 1
    return 3 if surface.distance is None else 2


@dataclass(frozen=True)
class Surfaces:
    """A list; surface number i, from 1, is known in an answer by its red, i / 256."""

    surfaces: tuple[Surface, ...]

    def numbers(self) -> list[Number]:
        numbers: list[Number] = [len(self.surfaces)]
        for surface in self.surfaces:
            numbers += [_kind(surface), *surface.numbers()]
        return numbers

    def words(self) -> str:
        shown = [f"{i}: {surface.words()}" for i, surface in enumerate(self.surfaces[:_MOST_IN_WORDS], 1)]
        left = len(self.surfaces) - len(shown)
        return "; ".join(shown) + (f"; and {left} more" if left else "") or "none"
