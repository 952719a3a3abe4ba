"""Scripted renderers: what they answer to trace, and what they were asked."""

from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from raysteps.common.vectors import Vector
from raysteps.judge.protocol import Number, Ray, TokenReader, text, vector_words

MAX_ASKED = 1000


@dataclass(frozen=True)
class ScriptedHit:
    """What the next ray meets; the worker places it on that ray and turns the normal towards it."""

    distance: float  # no two of a script are alike
    normal: Vector
    ks: float
    local: Vector  # what direct_lighting gives for it

    def numbers(self) -> list[Number]:
        return [self.distance, *self.normal, self.ks, *self.local]

    def words(self) -> str:
        return (
            f"a hit at {text(self.distance)} with normal {vector_words(self.normal)}, ks {text(self.ks)}, "
            f"local light {vector_words(self.local)}, colour {vector_words((*self.local[1:], self.local[0]))}"
        )


@dataclass(frozen=True)
class Script:
    max_depth: int
    background: Vector
    hits: tuple[ScriptedHit, ...]

    def numbers(self) -> list[Number]:
        return [self.max_depth, *self.background, len(self.hits), *(n for hit in self.hits for n in hit.numbers())]

    def words(self) -> str:
        hits = ", then ".join([*(hit.words() for hit in self.hits), "misses"])
        return f"max_ray_depth {self.max_depth}, background {vector_words(self.background)}; the rays meet {hits}"


@dataclass(frozen=True)
class TracedCall:
    """The colour, and what the renderer was asked for it."""

    color: Vector
    cast: tuple[Ray, ...]
    shaded: tuple[tuple[float, int], ...]  # distance of the hit, depth


def read_traced(tokens: TokenReader) -> TracedCall:
    color = tokens.vector()
    cast = tuple(Ray(tokens.vector(), tokens.vector()) for _ in range(tokens.whole(0, MAX_ASKED)))
    shaded = tuple((tokens.real(), tokens.whole(-MAX_ASKED)) for _ in range(tokens.whole(0, MAX_ASKED)))
    return TracedCall(color, cast, shaded)


def traced_words(answer: TracedCall) -> str:
    cast = "; ".join(ray.words() for ray in answer.cast) or "none"
    shaded = (
        ", ".join(f"of the hit at {text(distance)} at depth {depth}" for distance, depth in answer.shaded) or "none"
    )
    return f"colour {vector_words(answer.color)}; rays cast: {cast}; direct_lighting asked: {shaded}"


# What a path finds (step 13).


@dataclass(frozen=True)
class Scatter:
    """Where it goes on; the worker turns the direction to the side of the normal."""

    direction: Vector
    weight: Vector
    specular: bool = False

    def numbers(self) -> list[Number]:
        return [*self.direction, *self.weight, int(self.specular)]

    def words(self) -> str:
        kind = "specular" if self.specular else "diffuse"
        return f"scatter {vector_words(self.direction)} weight {vector_words(self.weight)} {kind}"


@dataclass(frozen=True)
class PathHit:
    """What the next ray meets; the worker places it on that ray and turns the normal towards it."""

    distance: float  # no two of a script are alike
    normal: Vector
    emission: Vector
    light: Vector  # what light_sample gives
    scatter: Scatter | None
    front_face: bool = True

    def numbers(self) -> list[Number]:
        scatter = [0] if self.scatter is None else [1, *self.scatter.numbers()]
        return [self.distance, *self.normal, *self.emission, int(self.front_face), *self.light, *scatter]

    def words(self) -> str:
        side = "" if self.front_face else ", met from behind"
        return (
            f"a hit at {text(self.distance)} with normal {vector_words(self.normal)}{side}, emission "
            f"{vector_words(self.emission)}, light_sample {vector_words(self.light)}, "
            f"{'no scatter' if self.scatter is None else self.scatter.words()}"
        )


class _Numbered(Protocol):
    """A hit of a script."""

    def numbers(self) -> list[Number]: ...

    def words(self) -> str: ...


H = TypeVar("H", bound=_Numbered)


@dataclass(frozen=True)
class _Hits(Generic[H]):
    """`goes_on`: the last hit comes again and again."""

    background: Vector
    goes_on: bool
    hits: tuple[H, ...]

    def numbers(self) -> list[Number]:
        hits = (n for hit in self.hits for n in hit.numbers())
        return [*self.background, int(self.goes_on), len(self.hits), *hits]

    def words(self) -> str:
        end = "the last one again and again" if self.goes_on else "misses"
        hits = ", then ".join([*(hit.words() for hit in self.hits), end])
        return f"background {vector_words(self.background)}; the rays meet {hits}"


class PathScript(_Hits[PathHit]):
    """Of step 13."""


# What a path finds in two ways (step 15).


@dataclass(frozen=True)
class DirectSample:
    """Of a lamp: what it brings, and the densities of both ways."""

    light: Vector
    pdf: float
    scatter_pdf: float

    def numbers(self) -> list[Number]:
        return [*self.light, self.pdf, self.scatter_pdf]

    def words(self) -> str:
        return f"light {vector_words(self.light)} pdf {text(self.pdf)} scatter_pdf {text(self.scatter_pdf)}"


@dataclass(frozen=True)
class DirectSamples:
    samples: tuple[DirectSample, ...]

    def numbers(self) -> list[Number]:
        return [len(self.samples), *(number for sample in self.samples for number in sample.numbers())]

    def words(self) -> str:
        return "; ".join(sample.words() for sample in self.samples) or "none"


@dataclass(frozen=True)
class WeighedScatter:
    """Where a path goes on, and how likely that is."""

    scatter: Scatter
    pdf: float

    def numbers(self) -> list[Number]:
        return [*self.scatter.numbers(), self.pdf]

    def words(self) -> str:
        return f"{self.scatter.words()} pdf {text(self.pdf)}"


@dataclass(frozen=True)
class PlateLamp:
    """Seen from its plate wherever the cosine with the normal lies between the two; its samples are even there."""

    low: float
    high: float
    radiance: Vector

    def numbers(self) -> list[Number]:
        return [self.low, self.high, *self.radiance]

    def words(self) -> str:
        return f"lamp at cosines from {text(self.low)} to {text(self.high)} radiance {vector_words(self.radiance)}"


@dataclass(frozen=True)
class MisHit:
    """What the next ray meets. `exponent` above 0: a plate, which scatters by the cosine to that power instead of in
    the direction that is scripted, and draws samples of its lamps."""

    distance: float  # no two of a script are alike, and all are above 1
    normal: Vector
    emission: Vector
    front_face: bool
    light_pdf: float  # of the lamp that it is, from the hit before
    samples: DirectSamples
    scatter: WeighedScatter | None
    exponent: float = 0.0
    lamps: tuple[PlateLamp, ...] = ()

    def numbers(self) -> list[Number]:
        scatter = [0] if self.scatter is None else [1, *self.scatter.numbers()]
        lamps = [len(self.lamps), *(n for lamp in self.lamps for n in lamp.numbers())]
        surface = [self.distance, *self.normal, *self.emission, int(self.front_face)]
        return [*surface, self.light_pdf, *self.samples.numbers(), *scatter, self.exponent, *lamps]

    def words(self) -> str:
        side = "" if self.front_face else ", met from behind"
        plate = f", plate of exponent {text(self.exponent)}" if self.exponent else ""
        return (
            f"a hit at {text(self.distance)} with normal {vector_words(self.normal)}{side}, emission "
            f"{vector_words(self.emission)}, light_pdf {text(self.light_pdf)}, direct_samples {self.samples.words()}, "
            f"{'no scatter' if self.scatter is None else self.scatter.words()}{plate}"
            f"{''.join(f', {lamp.words()}' for lamp in self.lamps)}"
        )


class MisScript(_Hits[MisHit]):
    """Of step 15."""
