"""How hard a step's structure made the rays work, beside the reference: tests that were counted, never seconds.

A surface test and a box test weigh alike. Of a picture it is (surface tests + box tests) per ray, as a multiple of the
reference's; of a step the geometric mean of its pictures that have a max_share.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from raysteps.common.text import join_and, mean
from raysteps.course.manifest import Step
from raysteps.results.model import ImageResult, StepResult
from raysteps.results.statuses import in_words

_DIGITS = 6  # the same on every machine, whatever its logarithm does in the last place
_NO_PICTURES = ("not-started", "does-not-build")


@dataclass(frozen=True)
class WorkRatio:
    """Of one step of one submission."""

    relative: float  # 1 is the reference's
    bytes: int  # of the structures of all pictures
    reference_bytes: int
    pictures: Mapping[str, float]  # each picture's multiple


@dataclass(frozen=True)
class NoWorkRatio:
    """Why there is nothing to compare."""

    reason: str


def _pictures_are(names: Sequence[str]) -> str:
    return f"pictures {join_and(names)} are" if len(names) > 1 else f"picture {names[0]} is"


def _wrong(images: Sequence[ImageResult]) -> str:
    """What is not right; a right picture may also have cost too much."""
    wrong = [image for image in images if not image.passed]
    shown = [image.wrong_share is not None and image.wrong_share <= image.max_wrong for image in wrong]
    costly = [image.name for image, right in zip(wrong, shown, strict=True) if right]
    false = [image.name for image, right in zip(wrong, shown, strict=True) if not right]
    if false:
        return f"{_pictures_are(false)} not right"
    return f"{_pictures_are(costly)} right, but the work that was counted did not pass" if costly else ""


def relative_work(image: ImageResult) -> float | NoWorkRatio:
    """Of one picture; 1 is the reference's."""
    name = image.name
    mine, reference = image.work, image.reference_work
    if mine is None or reference is None:
        return NoWorkRatio(f"picture {name} has no counters, as when an older kit graded it; grade it again")
    if not mine.rays or not mine.surface_tests or not reference.tests_per_ray:
        return NoWorkRatio(f"picture {name}: no test of a surface was counted")
    if reference.box_tests and not mine.box_tests:
        return NoWorkRatio(f"picture {name}: no test of a box was counted, as when boxes are not asked by box.hit(ray)")
    return mine.tests_per_ray / reference.tests_per_ray


def limited(result: StepResult) -> list[ImageResult]:
    """The pictures of a step in which few objects may be tested."""
    return [image for image in result.images if image.max_share is not None]


def work_ratio_of(result: StepResult, expected: Sequence[str] = ()) -> WorkRatio | NoWorkRatio:
    """Of one step. `expected` are the pictures that count and must be there; else all that have a
    max_share."""
    if result.status in _NO_PICTURES:
        return NoWorkRatio(in_words(result.status))
    problem = _wrong(result.images)
    if problem:
        return NoWorkRatio(problem)
    images = [image for image in limited(result) if not expected or image.name in expected]
    missing = [name for name in expected if name not in {image.name for image in images}]
    if missing or not images:
        return NoWorkRatio(f"{_pictures_are(missing)} not in the results" if missing else "no picture has counters")
    pictures: dict[str, float] = {}
    for image in images:
        relative = relative_work(image)
        if isinstance(relative, NoWorkRatio):
            return relative
        pictures[image.name] = round(relative, _DIGITS)
    mean = math.exp(math.fsum(math.log(max(value, 10**-_DIGITS)) for value in pictures.values()) / len(pictures))
    mine = sum(image.work.bytes for image in images if image.work)
    reference = sum(image.reference_work.bytes for image in images if image.reference_work)
    return WorkRatio(round(mean, _DIGITS), mine, reference, pictures)


# How good a step's tree is, in words. One scene of the step decides, the picture with `paper_tests` in its manifest. A
# tier gives no points.

_ALIKE = 0.02  # so much more or less is as good as the reference


@dataclass(frozen=True)
class WorkTier:
    """`name` is what was reached; `others` are all tiers in their order, each with the most tests per ray."""

    name: str
    picture: str
    tests_per_ray: float
    others: tuple[tuple[str, float], ...]

    @property
    def reached(self) -> str:
        """As one line."""
        return f"{self.name}: {mean(self.tests_per_ray)} tests per ray in {self.picture}"

    @property
    def to_reach(self) -> str:
        """As one line."""
        return ", ".join(f"{name} {mean(most)}" for name, most in self.others)


def image_tier(image: ImageResult, step: Step) -> WorkTier | None:
    """None where no tier hangs on the picture, and where it is not right or was not counted."""
    case = next((case for case in step.images if case.name == image.name), None)
    if case is None or case.paper_tests is None or not image.passed or isinstance(relative_work(image), NoWorkRatio):
        return None
    assert image.work is not None
    assert image.reference_work is not None
    mine, reference = image.work.tests_per_ray, image.reference_work.tests_per_ray
    tiers = (
        ("the paper's 64 boxes", case.paper_tests),
        ("a good tree", math.sqrt(case.paper_tests * reference)),  # half way, by factors
        ("as good as the reference", (1 + _ALIKE) * reference),
        ("better than the reference", (1 - _ALIKE) * reference),
    )
    reached = [name for name, most in tiers if mine <= most]
    none = "not yet the paper's 64 boxes, which ask each surface once"
    return WorkTier(reached[-1] if reached else none, case.name, mine, tiers)


def work_tier(result: StepResult, step: Step) -> WorkTier | None:
    """Of the one scene that decides."""
    return next((tier for image in result.images if (tier := image_tier(image, step)) is not None), None)
