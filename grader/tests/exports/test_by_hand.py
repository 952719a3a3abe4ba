"""What people changed and said, in what other systems take."""

from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

import pytest

from raysteps.course.manifest import Step
from raysteps.exports.autolab import to_autolab
from raysteps.exports.formats import validate
from raysteps.exports.github import to_classroom50, to_legacy
from raysteps.exports.gradescope import to_gradescope
from raysteps.exports.hosted import by_id
from raysteps.exports.items import summary
from raysteps.exports.prairielearn import to_prairielearn
from raysteps.results.model import (
    Comment,
    PointsOverride,
    RegradeRequest,
    Results,
    Review,
    StepResult,
    TestResult,
    Total,
)

pytestmark = pytest.mark.portable
_AT = "2026-11-20T18:00:00+00:00"
_ENVIRONMENT = {
    "CLASSROOM": "c", "ASSIGNMENT": "a", "SUBMISSION_TAG": "submit/1", "COMMIT_URL": "http://c", "RELEASE_URL": "http://r"
}  # fmt: skip


def _results(steps: list[Step], extra: float) -> Results:
    """Step 01 has 6 of its points instead of 4."""
    made = [
        StepResult(step.id, "partial", 4.0, step.points, step.bonus, [TestResult("t", True), TestResult("u", False)])
        for step in steps
    ]
    review = Review(
        4.0,
        [PointsOverride("tests", 1.0, 3.0, "half of it is right", "Ada", _AT)],
        [Comment("Ada", _AT, "why two?", 3, 2, ["int a;", "int b;"])],
        [RegradeRequest("was it?", "Ada", _AT, "answered", "It was.", "Ada", _AT)],
    )
    made[0] = replace(made[0], points=6.0, review=review)
    whole = Review(0.0, [PointsOverride("", 0.0, extra, "a nice picture", "Ada", _AT)])
    return replace(Results.of("ann", made), total=Total.of(made, extra), review=whole)


def _total(results: Results) -> float:
    return results.total.points


@pytest.mark.parametrize("extra", [2.0, -2.5, 0.0])
def test_points_add_up_everywhere(steps: list[Step], tmp_path: Any, extra: float) -> None:
    results, known = _results(steps, extra), by_id(steps)
    assert _total(results) == 4 * len(steps) + 2 + extra
    gradescope = to_gradescope(results, known)
    validate(gradescope, "gradescope")
    assert sum(test["score"] for test in gradescope["tests"]) == pytest.approx(_total(results))
    prairielearn = to_prairielearn(results, known, tmp_path)
    validate(prairielearn, "prairielearn")
    assert sum(test["points"] for test in prairielearn["tests"]) == pytest.approx(_total(results))
    assert prairielearn["score"] == pytest.approx(_total(results) / results.total.max)
    autolab = to_autolab(results, known)
    validate(autolab, "autolab")
    assert sum(autolab[1]["scores"].values()) == pytest.approx(_total(results))
    assert autolab[1]["scoreboard"][0] == _total(results)
    whole = to_classroom50(results, known, _ENVIRONMENT, datetime(2026, 11, 20, tzinfo=UTC))
    validate(whole, "classroom50")
    assert whole["score"] == sum(test["score"] for test in whole["tests"]) == int(_total(results) + 0.5)
    legacy = to_legacy(results, known)
    validate(legacy, "github-legacy")
    assert sum(test["score"] for test in legacy["tests"]) == int(_total(results) + 0.5)


def test_the_reasons_are_told(steps: list[Step]) -> None:
    text = summary(_results(steps, 2.0), by_id(steps))
    for words in (
        "Your instructor changed the points for tests from 1 to 3: half of it is right (Ada)",
        "Line 3: `int b;`: why two? (Ada)",
        "You asked: was it? Answer (Ada): It was.",
        "+2 points for the submission as a whole, from your instructor: a nice picture",
    ):
        assert words in text
    for made in (to_gradescope(_results(steps, 2.0), by_id(steps)), to_legacy(_results(steps, 2.0), by_id(steps))):
        assert "half of it is right" in str(made)
        assert "a nice picture" in str(made)
