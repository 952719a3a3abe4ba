"""results.json."""

import json
from pathlib import Path

import pytest

from raysteps.common.documents import Malformed, as_text
from raysteps.common.errors import GraderFault
from raysteps.grading.scoring import exit_code
from raysteps.results.model import CaseGroup, HiddenResult, ImageResult, Results, StepResult, TestResult, Work
from raysteps.results.store import parse_results, read_results, write_results
from raysteps.sandbox.task import Isolation

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
    path = write_results(Results.of("anna", [_step(), bonus]), tmp_path / "out")
    document = json.loads(path.read_text())
    assert document["schema"] == "raysteps/results/v1"
    assert document["total"] == {"points": 20.0, "max": 10.0, "bonus": {"points": 10.0, "max": 10.0}}
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["results.json"]


def test_a_document_that_breaks_the_schema_is_never_written(tmp_path: Path) -> None:
    with pytest.raises(GraderFault, match="status"):
        write_results(Results.of("anna", [_step(status="great")]), tmp_path)
    assert not list(tmp_path.iterdir())


_GOOD = as_text(Results.of("ann", [StepResult("01-camera-rays", "passed", 10.0, 10.0, False)], isolation=Isolation()))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"points": 10.0', '"points": "10"', r"^\$\.total\.points: expected int \| float, got str$"),
        ('"points": 10.0', '"points": -1', r"^\$\.total\.points: expected int >= 0$"),
        ('"points": 10.0', '"points": true', "got bool"),
        ('"points": 10.0', f'"points": {"9" * 400}', r"^\$\.total\.points: expected int <= \d+$"),
        ('"points": 10.0', '"points": 1e300', r"^\$\.total\.points: expected float <= "),
        ('"tests": [],', f'"tests": [], "{"x" * 10_000}": 1,', r"^\$\.steps\[0\]: unknown key 'x{50,290} \.\.\.$"),
        ('"status": "passed"', '"status": "\\ud800"', r"half a character|is not JSON"),
        ('"points": 10.0', '"points": NaN', r"is not JSON, or only a part of it \(line \d+, column \d+\)"),
        ('"points": 10.0', '"points": 1e999', "is not JSON"),
        ('"id": "01-camera-rays"', '"id": "../01"', r"^\$\.steps\[0\]\.id: expected str matching"),
        ('"tests": [],', "", r"^\$\.steps\[0\]: 'tests' is missing$"),
        ('"kit": "",', "", "missing required field kit"),
        ('"tests": [],', '"tests": [], "more": 1,', r"^\$\.steps\[0\]: unknown key 'more'; known are id, status,"),
        (
            '"tests": []',
            '"tests": [{"name": "t"}]',
            r"^\$\.steps\[0\]\.tests\[0\]: .* missing required field passed$",
        ),
        ('"tests": []', f'"tests": {"[" * 100_000}', "is not JSON"),
        (
            '"tests": []',
            f'"tests": {"[" * 200}{"]" * 200}',
            r"\.tests\[0\]: expected object, got array$",
        ),
        ("results/v1", "results/v2", "schema: invalid enum value 'raysteps/results/v2'"),
        ("{", "[{", "is not JSON, or only a part"),
    ],
)
def test_what_is_no_results_json_is_refused_with_its_place(old: str, new: str, said: str) -> None:
    assert old in _GOOD
    with pytest.raises(Malformed, match=said):
        parse_results(_GOOD.replace(old, new, 1).encode())


def test_what_only_older_kits_wrote_is_passed_over() -> None:
    """Where they wrote it, and nowhere else."""
    hidden = [HiddenResult("mirror", "function", 1.0, groups=[CaseGroup("any", 10, 10)])]
    now = as_text(Results.of("ann", [_step(hidden=hidden)]))
    older = now
    for key, former in (
        ("kit", '"inconsistent": true'),
        ("tests", '"inconsistent": ["a"]'),
        ("right", '"undecided": 1, "wasteful": 2'),
    ):
        assert older.count(f'"{key}"') == 1
        older = older.replace(f'"{key}"', f'{former}, "{key}"')
    assert as_text(parse_results(older.encode())) == now
    with pytest.raises(Malformed, match=r"^\$\.timing: unknown key 'inconsistent'"):
        parse_results(now.replace('"cpu_seconds"', '"inconsistent": true, "cpu_seconds"').encode())


def test_two_steps_of_one_name_are_refused() -> None:
    document = json.loads(_GOOD)
    document["steps"] *= 2
    with pytest.raises(Malformed, match=r"several steps are called 01-camera-rays$"):
        parse_results(json.dumps(document).encode())


def test_what_is_written_is_read(tmp_path: Path) -> None:
    bonus = _step(id="08-refraction", bonus=True)
    bonus.images = [ImageResult("i", "scenes/a.nff", True, 0.01, work=Work(1, 2, 3, 4, 5, 6))]
    results = Results.of("anna", [bonus])
    assert results.total.max == 0
    path = write_results(results, tmp_path)
    assert read_results(path) == results
    assert as_text(read_results(path)) == path.read_text()
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())  # as an editor of Windows saves it
    assert read_results(path) == results


def test_exit_codes() -> None:
    broken = _step(status="does-not-build")
    assert exit_code(Results.of("a", [_step(), _step(id="08-refraction", bonus=True, status="not-started")])) == 0
    assert exit_code(Results.of("a", [_step(id="02-intersection"), broken])) == 3
    assert exit_code(Results.of("a", [broken, _step(id="02-intersection", status="partial")])) == 1
    assert exit_code(Results.of("a", [_step(status="not-started")])) == 1
