"""Scripted renderers: what they answer to trace, and what they were asked."""

from dataclasses import dataclass

from raysteps.common.vectors import Vector
from raysteps.judge.protocol import Number, Ray, TokenReader, text, vector_words

MOST_ASKED = 1000


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
            f"local light {vector_words(self.local)}"
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
    cast = tuple(Ray(tokens.vector(), tokens.vector()) for _ in range(tokens.whole(0, MOST_ASKED)))
    shaded = tuple((tokens.real(), tokens.whole(-MOST_ASKED)) for _ in range(tokens.whole(0, MOST_ASKED)))
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


@dataclass(frozen=True)
class PathScript:
    """`goes_on`: the last hit comes again and again."""

    background: Vector
    goes_on: bool
    hits: tuple[PathHit, ...]

    def numbers(self) -> list[Number]:
        hits = (n for hit in self.hits for n in hit.numbers())
        return [*self.background, int(self.goes_on), len(self.hits), *hits]

    def words(self) -> str:
        end = "the last one again and again" if self.goes_on else "misses"
        hits = ", then ".join([*(hit.words() for hit in self.hits), end])
        return f"background {vector_words(self.background)}; the rays meet {hits}"
