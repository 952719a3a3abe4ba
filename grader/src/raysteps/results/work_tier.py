"""How good a step's tree is, in words: the tests of surfaces and boxes that a ray took, beside the paper's and the
reference's.

One scene of the step decides, the picture with `paper_tests` in its manifest. A tier gives no points.
"""

import math
from dataclasses import dataclass

from raysteps.common.text import mean
from raysteps.course.manifest import Step
from raysteps.results.model import ImageResult, StepResult
from raysteps.results.work_ratio import NoWorkRatio, relative_work

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
