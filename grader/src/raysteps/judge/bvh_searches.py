"""Searches through a tree of step 09: as those of step 06, and whether anything is hit before a distance."""

from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.judge.answers import Answer, Wasteful, first
from raysteps.judge.numbers import Number, text
from raysteps.judge.searches import SEARCHES, Search, WhoseTree, one_problem
from raysteps.judge.surfaces import Surfaces
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Inputs, Ray

_MOST_RAYS = 1000
_MOST_ASKED = 0.5  # of the surfaces, by a ray on average, where there are many rays
_ALL_ASKED = 0.9  # no tree at all, or a single leaf: a poor tree spares the rays more than that
_MOST_TIMES = 2.0  # what the reference asks, in a tree that is given


@dataclass(frozen=True)
class Reach:
    """A ray up to a distance."""

    ray: Ray
    distance: float

    def numbers(self) -> list[Number]:
        return [*self.ray.numbers(), self.distance]

    def words(self) -> str:
        return f"{self.ray.words()} up to {text(self.distance)}"


@dataclass(frozen=True)
class Reaches:
    rays: tuple[Reach, ...]

    def numbers(self) -> list[Number]:
        return [len(self.rays), *(number for reach in self.rays for number in reach.numbers())]

    def words(self) -> str:
        return "; ".join(reach.words() for reach in self.rays[:2]) + ("; and more" if len(self.rays) > 2 else "")


@dataclass(frozen=True)
class Found:
    """Whether one ray found something, and how many surfaces were asked for it."""

    asked: int
    hit: bool


def work_problem(inputs: Inputs, expected: Sequence[int], actual: Sequence[int]) -> str:
    """Of many rays: most surfaces must be spared them, and in a tree that is given nearly all that can be."""
    surfaces, tree = inputs["surfaces"], inputs["tree"]
    assert isinstance(surfaces, Surfaces)
    assert isinstance(tree, WhoseTree)
    if len(actual) < 2:
        return ""
    share = sum(actual) / (len(surfaces.surfaces) * len(actual))
    if share > _MOST_ASKED:
        said = "the hits are right, but too many surfaces were asked: the boxes must spare the rays most of them"
        return Wasteful(said) if share > _ALL_ASKED else said
    if not tree.own and sum(actual) > _MOST_TIMES * sum(expected):
        return "the hits are right, but surfaces were asked that the tree could have spared the rays"
    return ""


def _closest_problem(inputs: Inputs, expected: tuple[Search, ...], actual: tuple[Search, ...]) -> str:
    if len(expected) != len(actual):
        return "no proper answer came"
    problem = first(*(one_problem(*pair) for pair in zip(expected, actual, strict=True)))
    return problem or work_problem(inputs, [search.asked for search in expected], [search.asked for search in actual])


def _read(tokens: Tokens) -> tuple[Found, ...]:
    found: list[Found] = []
    while not tokens.at_end():
        if len(found) == _MOST_RAYS:
            raise Garbled("the answer is too long")
        found.append(Found(tokens.whole(), tokens.flag()))
    return tuple(found)


def _words(found: Sequence[Found]) -> str:
    shown = [f"{str(one.hit).lower()}, {one.asked} surfaces asked" for one in found[:2]]
    return "; ".join(shown) + ("; and more" if len(found) > 2 else "") or "nothing"


def _one_problem(expected: Found, actual: Found) -> str:
    if expected.hit != actual.hit:
        return "something is hit, and the answer is no" if expected.hit else "nothing is hit, and the answer is yes"
    return "a hit came without asking a surface" if actual.hit and actual.asked == 0 else ""


def _any_problem(inputs: Inputs, expected: tuple[Found, ...], actual: tuple[Found, ...]) -> str:
    if len(expected) != len(actual):
        return "no proper answer came"
    problem = first(*(_one_problem(*pair) for pair in zip(expected, actual, strict=True)))
    return problem or work_problem(inputs, [one.asked for one in expected], [one.asked for one in actual])


CLOSEST_IN_BVH = Answer(SEARCHES.read, SEARCHES.words, _closest_problem)
ANY_IN_BVH = Answer(_read, _words, _any_problem)
