"""Proof that the hand-made results are as the grader writes them."""

import random

import pytest
from export_documents import HOSTILE, document, full, step_result

from raysteps.course.manifest import Step
from raysteps.results.model import PointSum, Total

pytestmark = pytest.mark.portable


@pytest.mark.parametrize("seed", range(3))
def test_the_grader_would_accept_them(steps: list[Step], seed: int) -> None:
    share = random.Random(seed).random()
    made = document([step_result(step, share=share, text=HOSTILE) for step in steps])
    assert 0 < made.total.points < made.total.max
    assert full(steps).total == Total(120.0, 100.0, PointSum(20.0, 20.0))
