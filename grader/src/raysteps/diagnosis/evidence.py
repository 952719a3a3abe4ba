"""What was seen of a step that is not right."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from raysteps.diagnosis.answers import Answers, Questions
from raysteps.kit.manifest import ImageCase
from raysteps.programs.pictures import TOLERANCE, Pixels, gaps, is_flat

Mask = npt.NDArray[np.bool_]


def differing(one: Pixels, other: Pixels, tolerance: int = TOLERANCE) -> Mask:
    """The pixels in which two pictures of one size are not the same."""
    mask: Mask = gaps(one, other) > tolerance
    return mask


@dataclass(frozen=True)
class Picture:
    """A student's picture beside the reference's, of one size."""

    case: ImageCase
    mine: Pixels
    reference: Pixels

    @cached_property
    def wrong(self) -> Mask:
        return differing(self.mine, self.reference)

    @property
    def is_wrong(self) -> bool:
        return float(self.wrong.mean()) > self.case.max_wrong

    @property
    def says_something(self) -> bool:
        """A picture of one colour may have any cause."""
        return not is_flat(self.mine) or is_flat(self.reference)


@dataclass(frozen=True)
class Evidence:
    """`questions` and `answers` are of the functions that were asked, `pictures` are those that came out."""

    questions: Mapping[str, Questions]
    answers: Answers
    pictures: Mapping[str, Picture]

    @property
    def is_wrong(self) -> bool:
        """Whether there is anything to explain."""
        return any(self.answers.values()) or any(picture.is_wrong for picture in self.pictures.values())
