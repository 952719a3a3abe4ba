"""Searches through a tree: which rays, in whose tree, and what was found with how much work."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from raysteps.common.text import count
from raysteps.judge.answers import Answer, TooMuchWork, first
from raysteps.judge.hits import MaybeHit, found_problem, found_words, read_hit
from raysteps.judge.protocol import Inputs, Number, ProtocolError, Ray, TokenReader, text
from raysteps.judge.surfaces import Surfaces

_MAX_RAYS = 1000
MAX_ASKED_SHARE = 0.5  # of the surfaces, by a ray on average, where there are many rays


@dataclass(frozen=True)
class TreeSource:
    own: bool  # made by the submission's own build_octree

    def numbers(self) -> list[Number]:
        return [int(self.own)]

    def words(self) -> str:
        given = "three levels of boxes, or one for two surfaces, each with those that touch it"
        return "made by build_octree" if self.own else given


@dataclass(frozen=True)
class BvhSource(TreeSource):
    def words(self) -> str:
        return "made by build_bvh" if self.own else "lists halved along x, y and z in turn, up to 3 surfaces in a leaf"


@dataclass(frozen=True)
class RaySegment:
    """A ray up to a distance."""

    ray: Ray
    distance: float

    def numbers(self) -> list[Number]:
        return [*self.ray.numbers(), self.distance]

    def words(self) -> str:
        return f"{self.ray.words()} up to {text(self.distance)}"


_Ray = TypeVar("_Ray", Ray, RaySegment)


@dataclass(frozen=True)
class _ManyRays(Generic[_Ray]):
    rays: tuple[_Ray, ...]

    def numbers(self) -> list[Number]:
        return [len(self.rays), *(number for ray in self.rays for number in ray.numbers())]

    def words(self) -> str:
        return "; ".join(ray.words() for ray in self.rays[:2]) + ("; and more" if len(self.rays) > 2 else "")


class Rays(_ManyRays[Ray]):
    """Each without an end."""


class RaySegments(_ManyRays[RaySegment]):
    """Each up to a distance of its own."""


@dataclass(frozen=True)
class SearchResult:
    """What one ray found, and how many surfaces were asked for it."""

    asked: int
    found: MaybeHit


class CountedAnswer(Protocol):
    """The answer for one ray."""

    @property
    def asked(self) -> int: ...


One = TypeVar("One", bound=CountedAnswer)
WorkCheck = Callable[[Inputs, Sequence[int], Sequence[int]], str]  # what the reference asked, and what was asked


def read_all(tokens: TokenReader, read_one: Callable[[TokenReader], One]) -> tuple[One, ...]:
    """An answer for each ray."""
    found: list[One] = []
    while not tokens.at_end():
        if len(found) == _MAX_RAYS:
            raise ProtocolError("the answer is too long")
        found.append(read_one(tokens))
    return tuple(found)


def words_of(answers: Sequence[One], one_in_words: Callable[[One], str]) -> str:
    """The first two."""
    shown = [f"{one_in_words(answer)}, {count(answer.asked, 'surface')} asked" for answer in answers[:2]]
    return "; ".join(shown) + ("; and more" if len(answers) > 2 else "") or "nothing"


def problem_of(
    inputs: Inputs,
    answers: tuple[Sequence[One], Sequence[One]],
    one_problem: Callable[[One, One], str],
    work_problem: WorkCheck,
) -> str:
    """Of the expected and the actual answers: the first that is wrong, and then the work."""
    expected, actual = answers
    if len(expected) != len(actual):
        return "no proper answer came"
    problem = first(*(one_problem(*pair) for pair in zip(expected, actual, strict=True)))
    return problem or work_problem(inputs, [one.asked for one in expected], [one.asked for one in actual])


def hit_without_asking(*, hit: bool, asked: int) -> str:
    return "a hit came without asking a surface" if hit and asked == 0 else ""


def _read_one(tokens: TokenReader) -> SearchResult:
    return SearchResult(tokens.whole(), read_hit(tokens))


def one_problem(expected: SearchResult, actual: SearchResult) -> str:
    unasked = hit_without_asking(hit=actual.found.hit is not None, asked=actual.asked)
    return first(found_problem(expected.found, actual.found), unasked)


def too_many_asked(inputs: Inputs, expected: Sequence[int], asked: Sequence[int]) -> str:
    """Where there are many rays, the boxes must spare them most of the surfaces, whatever the reference asked."""
    surfaces = inputs["surfaces"]
    assert isinstance(surfaces, Surfaces)
    if len(asked) > 1 and sum(asked) > MAX_ASKED_SHARE * len(surfaces.surfaces) * len(asked):
        return TooMuchWork(_TOO_MANY_ASKED)
    return ""


def _problem(inputs: Inputs, expected: tuple[SearchResult, ...], actual: tuple[SearchResult, ...]) -> str:
    return problem_of(inputs, (expected, actual), one_problem, too_many_asked)


SEARCHES: Answer[tuple[SearchResult, ...]] = Answer(
    lambda tokens: read_all(tokens, _read_one),
    lambda searches: words_of(searches, lambda search: found_words(search.found)),
    _problem,
    constant=lambda searches: "; ".join(found_words(search.found) for search in searches),
)


# Searches through a tree for any hit before a distance: yes or no, and with how much work.


@dataclass(frozen=True)
class Occlusion:
    """Whether one ray meets anything before the distance, and how many surfaces were asked for it."""

    asked: int
    found: bool


def _read_occlusion(tokens: TokenReader) -> Occlusion:
    return Occlusion(tokens.whole(), tokens.flag())


def _one_in_words(answer: Occlusion) -> str:
    return "true, something is hit nearer" if answer.found else "false, nothing is hit nearer"


def one_occlusion_problem(expected: Occlusion, actual: Occlusion) -> str:
    if expected.found and not actual.found:
        return "a surface is hit nearer than the distance, and the answer is that none is"
    if actual.found and not expected.found:
        return "no surface is hit nearer than the distance, and the answer is that one is"
    return hit_without_asking(hit=actual.found, asked=actual.asked)


def _occlusion_problem(inputs: Inputs, expected: tuple[Occlusion, ...], actual: tuple[Occlusion, ...]) -> str:
    return problem_of(inputs, (expected, actual), one_occlusion_problem, too_many_asked)


OCCLUSIONS: Answer[tuple[Occlusion, ...]] = Answer(
    lambda tokens: read_all(tokens, _read_occlusion),
    lambda answers: words_of(answers, _one_in_words),
    _occlusion_problem,
    constant=lambda answers: " ".join(str(answer.found) for answer in answers),
)


# Searches through a tree of step 09: as those of step 06, and whether anything is hit before a distance.

_TOO_MANY_ASKED = "the hits are right, but too many surfaces were asked: the boxes must spare the rays most of them"
_ALL_ASKED = 0.9  # no tree at all, or a single leaf: a poor tree spares the rays more than that
_MAX_TIMES = 2.0  # what the reference asks, in a tree that is given


def work_problem(inputs: Inputs, expected: Sequence[int], actual: Sequence[int]) -> str:
    """Of many rays: most surfaces must be spared them, and in a tree that is given nearly all that can be."""
    surfaces, tree = inputs["surfaces"], inputs["tree"]
    assert isinstance(surfaces, Surfaces)
    assert isinstance(tree, TreeSource)
    if len(actual) < 2 or not surfaces.surfaces:
        return ""
    share = sum(actual) / (len(surfaces.surfaces) * len(actual))
    if share > MAX_ASKED_SHARE:
        return TooMuchWork(_TOO_MANY_ASKED) if share > _ALL_ASKED else _TOO_MANY_ASKED
    if not tree.own and sum(actual) > _MAX_TIMES * sum(expected):
        return "the hits are right, but surfaces were asked that the tree could have spared the rays"
    return ""


def _closest_problem(inputs: Inputs, expected: tuple[SearchResult, ...], actual: tuple[SearchResult, ...]) -> str:
    return problem_of(inputs, (expected, actual), one_problem, work_problem)


def _any_problem(inputs: Inputs, expected: tuple[Occlusion, ...], actual: tuple[Occlusion, ...]) -> str:
    return problem_of(inputs, (expected, actual), one_occlusion_problem, work_problem)


CLOSEST_IN_BVH = Answer(SEARCHES.read, SEARCHES.words, _closest_problem, constant=SEARCHES.constant)
OCCLUSIONS_IN_BVH = Answer(OCCLUSIONS.read, OCCLUSIONS.words, _any_problem, constant=OCCLUSIONS.constant)
