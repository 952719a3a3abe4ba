"""Searches through a tree: which rays, in whose tree, and what was found with how much work."""

from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.judge.answers import Answer, Wasteful, first
from raysteps.judge.hits import MaybeHit, found_problem, found_words, read_hit
from raysteps.judge.numbers import Number
from raysteps.judge.surfaces import Surfaces
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Inputs, Ray

MOST_RAYS = 1000
_MOST_ASKED = 0.5  # of the surfaces, by a ray on average, where there are many rays


@dataclass(frozen=True)
class WhoseTree:
    own: bool  # made by the submission's own build_octree

    def numbers(self) -> list[Number]:
        return [int(self.own)]

    def words(self) -> str:
        return "made by build_octree" if self.own else "three levels of boxes, each with the surfaces that touch it"


@dataclass(frozen=True)
class WhoseBvh(WhoseTree):
    def words(self) -> str:
        return "made by build_bvh" if self.own else "lists halved along x, y and z in turn, up to 3 surfaces in a leaf"


@dataclass(frozen=True)
class Rays:
    rays: tuple[Ray, ...]

    def numbers(self) -> list[Number]:
        return [len(self.rays), *(number for ray in self.rays for number in ray.numbers())]

    def words(self) -> str:
        return "; ".join(ray.words() for ray in self.rays[:2]) + ("; and more" if len(self.rays) > 2 else "")


@dataclass(frozen=True)
class Search:
    """What one ray found, and how many surfaces were asked for it."""

    asked: int
    found: MaybeHit


def _read(tokens: Tokens) -> tuple[Search, ...]:
    searches: list[Search] = []
    while not tokens.at_end():
        if len(searches) == MOST_RAYS:
            raise Garbled("the answer is too long")
        searches.append(Search(tokens.whole(), read_hit(tokens)))
    return tuple(searches)


def _words(searches: Sequence[Search]) -> str:
    shown = [f"{found_words(search.found)}, {search.asked} surfaces asked" for search in searches[:2]]
    return "; ".join(shown) + ("; and more" if len(searches) > 2 else "") or "nothing"


def one_problem(expected: Search, actual: Search) -> str:
    unasked = actual.found.hit is not None and actual.asked == 0
    return first(found_problem(expected.found, actual.found), "a hit came without asking a surface" if unasked else "")


def too_many_asked(inputs: Inputs, asked: Sequence[int]) -> str:
    """Where there are many rays, the boxes must spare them most of the surfaces."""
    surfaces = inputs["surfaces"]
    assert isinstance(surfaces, Surfaces)
    if len(asked) > 1 and sum(asked) > _MOST_ASKED * len(surfaces.surfaces) * len(asked):
        return Wasteful(
            "the hits are right, but too many surfaces were asked: the boxes must spare the rays most of them"
        )
    return ""


def _problem(inputs: Inputs, expected: tuple[Search, ...], actual: tuple[Search, ...]) -> str:
    if len(expected) != len(actual):
        return "no proper answer came"
    return first(
        *(one_problem(*pair) for pair in zip(expected, actual, strict=True)),
        too_many_asked(inputs, [search.asked for search in actual]),
    )


SEARCHES = Answer(_read, _words, _problem)
