"""results.json."""

import json
from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault
from raysteps.grading.scoring import exit_code
from raysteps.results.model import ImageResult, Results, StepResult, TestResult
from raysteps.results.store import validate, write_document

pytestmark = pytest.mark.portable


def _step(**changes: object) -> StepResult:
    step = StepResult("01-camera-rays", "passed", 10.0, 10.0, False)
    for name, value in changes.items():
        setattr(step, name, value)
    return step


def test_the_bonus_is_on_top(tmp_path: Path) -> None:
    bonus = _step(id="08-refraction", bonus=True)
    bonus.tests = [TestResult("t", True)]
    bonus.images = [ImageResult("i", "scenes/a.nff", True, 0.01)]
    path = write_document(Results("anna", [_step(), bonus]).to_json(), tmp_path / "out")
    document = json.loads(path.read_text())
    assert document["schema"] == "raysteps/results/v1"
    assert document["total"] == {"points": 20.0, "max": 10.0, "bonus": {"points": 10.0, "max": 10.0}}
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["results.json"]


def test_a_document_that_breaks_the_schema_is_never_written(tmp_path: Path) -> None:
    with pytest.raises(GraderFault, match="status"):
        write_document(Results("anna", [_step(status="great")]).to_json(), tmp_path)
    assert not list(tmp_path.iterdir())
    with pytest.raises(GraderFault):
        validate({"schema": "raysteps/results/v1"})


def test_exit_codes() -> None:
    broken = _step(status="does-not-build")
    assert exit_code(Results("a", [_step(), _step(bonus=True, status="not-started")])) == 0
    assert exit_code(Results("a", [_step(), broken])) == 3
    assert exit_code(Results("a", [broken, _step(status="partial")])) == 1
    assert exit_code(Results("a", [_step(status="not-started")])) == 1
