"""Searches through a tree of step 09: as those of step 06, and whether anything is hit before a distance."""

from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.judge.answers import Answer, Wasteful
from raysteps.judge.any_hits import ANY_HITS, AnyHit, one_any_problem
from raysteps.judge.numbers import Number, text
from raysteps.judge.searches import MOST_ASKED, SEARCHES, Search, WhoseTree, one_problem, problem_of
from raysteps.judge.surfaces import Surfaces
from raysteps.judge.values import Inputs, Ray

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


def work_problem(inputs: Inputs, expected: Sequence[int], actual: Sequence[int]) -> str:
    """Of many rays: most surfaces must be spared them, and in a tree that is given nearly all that can be."""
    surfaces, tree = inputs["surfaces"], inputs["tree"]
    assert isinstance(surfaces, Surfaces)
    assert isinstance(tree, WhoseTree)
    if len(actual) < 2:
        return ""
    share = sum(actual) / (len(surfaces.surfaces) * len(actual))
    if share > MOST_ASKED:
        said = "the hits are right, but too many surfaces were asked: the boxes must spare the rays most of them"
        return Wasteful(said) if share > _ALL_ASKED else said
    if not tree.own and sum(actual) > _MOST_TIMES * sum(expected):
        return "the hits are right, but surfaces were asked that the tree could have spared the rays"
    return ""


def _closest_problem(inputs: Inputs, expected: tuple[Search, ...], actual: tuple[Search, ...]) -> str:
    return problem_of(inputs, (expected, actual), one_problem, work_problem)


def _any_problem(inputs: Inputs, expected: tuple[AnyHit, ...], actual: tuple[AnyHit, ...]) -> str:
    return problem_of(inputs, (expected, actual), one_any_problem, work_problem)


CLOSEST_IN_BVH = Answer(SEARCHES.read, SEARCHES.words, _closest_problem)
ANY_IN_BVH = Answer(ANY_HITS.read, ANY_HITS.words, _any_problem)
