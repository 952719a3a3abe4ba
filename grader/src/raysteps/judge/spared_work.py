"""Points for few tests of objects. A picture counts the tests that are asked for, and a search may do the arithmetic of
every object itself, so few that were counted prove nothing: what must have spared them is the tree, which the judge
looks at. Where it spares nothing, few tests earn nothing either.
"""

from collections.abc import Sequence

from raysteps.common.text import join_and
from raysteps.judge.answers import TooLarge, TooMuchWork
from raysteps.judge.functions import Function
from raysteps.judge.worker import JudgedCase
from raysteps.results.model import HiddenResult, ImageResult

_MOST = 0.5
_TOO_GOOD = 0.25  # of what is allowed: not even rays into the empty sky make it so little


def spares_nothing(function: Function, judged: Sequence[JudgedCase]) -> bool:
    """No case of a kind is right, and most are not because they spare no work: another mistake says nothing. Cases
    count that were asked, and whose answer could be read."""
    for group in function.groups:
        problems = [one.verdict.problem for one in judged if one.asked and one.case.group == group.name]
        readable = [problem for problem in problems if not isinstance(problem, TooLarge)]
        wasteful = sum(isinstance(problem, TooMuchWork) for problem in readable)
        if group.saves and all(readable) and wasteful > _MOST * len(readable):
            return True
    return False


def unspared(images: Sequence[ImageResult], hidden: Sequence[HiddenResult]) -> str:
    """Why few tests in the pictures of the step earn nothing, or nothing. Where most of a picture is sky, few objects
    are tested without any merit: so a step of which another picture tests too many keeps its points."""
    return "" if any(_is_above(image) for image in images) else why_unspared(hidden)


def take_back(images: Sequence[ImageResult], hidden: Sequence[HiddenResult]) -> None:
    """Of the visible pictures in which few objects may be tested."""
    why = why_unspared(hidden)
    every_one = unspared(images, hidden)
    for image in images:
        if not why or image.max_share is None:
            continue
        image.share = 0.0
        few = (image.share_tested or 0) < _TOO_GOOD * image.max_share
        if image.passed and (few or every_one):
            image.passed, image.outcome, image.message = False, "wrong", why


def _is_above(image: ImageResult) -> bool:
    return image.max_share is not None and (image.share_tested or 0) > image.max_share


def why_unspared(hidden: Sequence[HiddenResult]) -> str:
    """In words; nothing where the judge's cases are spared something."""
    names = [item.name for item in hidden if item.spares_nothing]
    if not names:
        return ""
    return (
        f"The picture is right, but nothing spared its few tests of objects: in the judge's cases {join_and(names)} "
        "spares a ray nothing. Let the tree spare them, and test a surface by surface->hit(ray) only."
    )
