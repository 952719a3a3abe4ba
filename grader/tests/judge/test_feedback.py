"""What a student is told of the hidden part."""

import pytest

from raysteps.grading.withhold import withhold
from raysteps.results.model import CaseGroup, Feedback, HiddenResult, Results, StepResult
from raysteps.results.store import validate

pytestmark = pytest.mark.portable

_SECRETS = ("given-secret", "expected-secret", "actual-secret")
_DIAGNOSIS = ("message-secret", "group-secret", "name-secret")


def _document() -> Results:
    wrong = HiddenResult("name-secret", "function", 0.5, weight=3.0, groups=[CaseGroup("group-secret", 10, 5)])
    wrong.message, wrong.given, wrong.expected, wrong.actual = "message-secret", *_SECRETS
    wrong.outcome = "wrong"
    right = HiddenResult("mirror", "function", 1.0, weight=1.0, groups=[CaseGroup("any", 10, 10)])
    picture = HiddenResult("name-secret-twin", "picture", 1.0, weight=2.0, wrong_share=0.001)
    step = StepResult("03-phong-shading", "partial", 7.5, 15, False, hidden=[wrong, right, picture])
    step.messages = ["1 of 12 tests failed.", "1 of 3 hidden items lost points.", "message-secret"]
    return Results.of("ada", [step])


def test_full_is_all() -> None:
    assert withhold(_document(), "full") == _document()


def test_diagnosis_keeps_what_is_wrong() -> None:
    document = withhold(_document(), "diagnosis")
    validate(document)
    text = str(document)
    assert all(word not in text for word in _SECRETS)
    assert all(word in text for word in _DIAGNOSIS)


def test_score_keeps_only_shares() -> None:
    document = withhold(_document(), "score")
    validate(document)
    text = str(document)
    assert all(word not in text for word in (*_SECRETS, *_DIAGNOSIS))
    cases, pictures = document.steps[0].hidden
    assert (cases.share, cases.weight, cases.outcome) == (0.625, 4.0, "wrong")
    assert (pictures.share, pictures.weight, pictures.outcome) == (1.0, 2.0, "ok")
    assert document.steps[0].messages == ["1 of 12 tests failed."]


@pytest.mark.parametrize("feedback", ["full", "diagnosis", "score"])
def test_points_stay_and_the_document_is_not_touched(feedback: Feedback) -> None:
    document = _document()
    withheld = withhold(document, feedback)
    assert document == _document()
    assert withheld.total == document.total
    assert withheld.steps[0].points == 7.5
