"""The last lines for Autolab."""

import json

import pytest
from export_documents import HOSTILE, full, mixed

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step
from raysteps.exports.autolab import as_lines, to_autolab
from raysteps.exports.formats import validate
from raysteps.exports.hosted import by_id

pytestmark = pytest.mark.portable


def test_the_last_line_holds_the_scores(steps: list[Step]) -> None:
    made = mixed(steps, HOSTILE)
    lines = to_autolab(made, by_id(steps))
    validate(lines, "autolab")
    text = as_lines(lines)
    assert text.count("\n") == 2
    feedback, scores = (json.loads(line) for line in text.splitlines())
    assert scores["scores"] == {result.id: result.points for result in made.steps}
    assert scores["scoreboard"] == [made.total.points, 2.5]
    assert feedback["stages"] == [step.id for step in steps]
    assert set(feedback) == {"_presentation", "stages", *feedback["stages"]}
    stage = feedback["02-intersection"]
    assert stage["test test 0"] == {"passed": True}
    assert stage["hidden function 0"]["passed"] is False
    assert "evil" in stage["hidden function 0"]["hint"]
    assert "secret" not in text


def test_without_an_octree_a_ray_tests_everything(steps: list[Step]) -> None:
    made = full(steps)
    made.steps[5].images[0].passed = False
    assert to_autolab(made, by_id(steps))[1]["scoreboard"] == [120.0, 100.0]


def test_checks_of_one_name_are_all_shown(steps: list[Step]) -> None:
    made = full(steps)
    for test in made.steps[0].tests:
        test.name = "same"
    assert len(to_autolab(made, by_id(steps))[0]["01-camera-rays"]) == 7 + 2 + 3 + 1


def test_the_schema_sees_what_is_wrong(steps: list[Step]) -> None:
    lines = to_autolab(full(steps), by_id(steps))
    lines[1]["scores"] = {}
    with pytest.raises(GraderFault):
        validate(lines, "autolab")
    with pytest.raises(GraderFault):
        validate(lines[:1], "autolab")
