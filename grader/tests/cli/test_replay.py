"""One case, asked again: files that are good, bad and missing, and what is printed."""

import io
import json
from pathlib import Path
from typing import Any

import pytest
from conftest import MakeSubmission, Sources
from rich.console import Console

from raysteps.cli import app as cli
from raysteps.cli.replay import replay
from raysteps.common.errors import StudentBuildError, UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.grading.pipeline import grade_submission
from raysteps.grading.step import clear_old_results
from raysteps.judge.counterexamples import SCHEMA, CaseFile, read_case, write_case
from raysteps.judge.decode_case import decode_inputs
from raysteps.judge.functions import Case, functions_of
from raysteps.judge.hidden_tests import make_cases
from raysteps.judge.plan import read_plan
from raysteps.judge.protocol import ProtocolError
from raysteps.results.model import Feedback, Settings
from raysteps.results.store import case_path
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit

_LINE = "1 Sphere::intersect 0 0 0 1 1 1 1 1 1 2 0 1 0 0 2 0 0 -1"
_CASE = CaseFile(
    SCHEMA,
    "02-intersection",
    "Sphere::intersect",
    "origin inside",
    _LINE,
    "the distance is wrong",
    "given",
    "one",
    "other",
)
_NEARER = "nearer > 0.0F ? nearer : to_closest + half_chord"


def _write(folder: Path, **changes: Any) -> Path:
    path = folder / "case.json"
    write_case(path, _CASE)
    document = json.loads(path.read_text("utf-8"))
    for name, value in changes.items():
        if value is None:
            del document[name]
        else:
            document[name] = value
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def test_inputs_can_be_read_back_from_the_line(project: Project, steps: list[Step]) -> None:
    for step in steps:
        plan = read_plan(project, step)
        assert plan is not None
        for function in plan.functions:
            known = functions_of(step.number)[function.name]
            for case in make_cases(step, function, 2):
                inputs = decode_inputs(known, case.line(1))
                assert list(inputs) == list(case.inputs)
                again = Case(case.function, case.group, inputs)
                assert again.line(1) == case.line(1)
                assert again.given() == case.given()


def test_a_case_can_be_read_back(tmp_path: Path) -> None:
    path = _write(tmp_path)
    assert read_case(path) == _CASE
    path.write_text(path.read_text().replace("{", '{"seed": 7,', 1))  # as older kits wrote it
    assert read_case(path) == _CASE
    assert list(tmp_path.iterdir()) == [tmp_path / "case.json"], "no temporary file is left"


def test_names_of_files(steps: list[Step]) -> None:
    names = [case_path(step.number, function) for step in steps for function in step.functions]
    assert len(set(names)) == len(names)
    assert case_path("02", "Sphere::intersect") == "cases/02-sphere-intersect.json"
    assert case_path("01", "point_at") == "cases/01-point-at.json"


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"line": 5}, r"\$\.line: expected str, got int"),
        ({"line": None}, "missing required field line"),
        ({"schema": "raysteps/case/v9"}, r"\$\.schema: invalid enum value 'raysteps/case/v9'"),
        (
            {"schema": "raysteps/class/v1"},
            r"it is JSON of another kind \(raysteps/class/v1\); expected the file of one",
        ),
        ({"schema": "raysteps/\x1b[31m" + "x" * 100}, r"another kind \(raysteps/[^\x1b]{40,80}\); expected"),
        ({"schema": None}, "it is other JSON; expected the file of one hidden case, such as cases/02-closest-hit.json"),
        ({"colour": 1}, "colour"),
        ({"step": "09-none"}, "step: expected one of 01-camera-rays, .*found '09-none'"),
        ({"function": "trace"}, "function: expected one of Triangle::intersect, .*found 'trace'"),
        ({"line": "1 trace 1"}, "line: expected a case of Sphere::intersect, found trace"),
        ({"line": _LINE + " 3"}, "line: there are more numbers than the function takes"),
        ({"line": _LINE[:-3]}, "line: ray: the line is too short"),
        ({"line": _LINE.replace("-1", "up")}, "line: ray: the line holds a word where a number belongs"),
        ({"line": "1"}, "line: "),
    ],
)
def test_a_bad_case_is_told(project: Project, tmp_path: Path, changes: dict[str, Any], said: str) -> None:
    path = _write(tmp_path, **changes)
    with pytest.raises(UsageError, match=said) as caught:
        replay(project, path, None, Console(file=io.StringIO()))
    assert str(caught.value).startswith(str(path))


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"\xff\xfe", b"[" * 100_000, b'"x"', b" " * (1 << 21)])
def test_a_file_that_is_no_case(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "odd.json"
    path.write_bytes(content)
    with pytest.raises(UsageError, match=r"odd\.json: .*expected a case as `check` writes it"):
        read_case(path)


@pytest.mark.parametrize(
    ("steps", "said"),
    [
        (
            [{"hidden": [{"case": "cases/02-closest-hit.json"}, {"case": ""}, 7]}, {}, {"hidden": 3}, None],
            "It names:\n  FOLDER/cases/02-closest-hit.json",
        ),
        ([], "It names none: all were right, or none were asked"),
        (5, "It names none: all were right, or none were asked"),
    ],
)
def test_a_results_file_is_known_and_the_cases_that_it_names_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], steps: Any, said: str
) -> None:
    path = tmp_path / "results.json"
    path.write_text(json.dumps({"schema": "raysteps/results/v1", "steps": steps}))
    assert cli.main(["replay", str(path)]) == 2
    wanted = "this is a results.json; replay wants the file of one hidden case."
    assert capsys.readouterr().err == f"raysteps: {path}: {wanted} {said.replace('FOLDER', str(tmp_path))}\n"


@pytest.mark.parametrize(("name", "says"), [("nothing.json", "is not there"), (".", "a folder; name a file in it")])
def test_a_file_that_is_not_there(tmp_path: Path, name: str, says: str) -> None:
    with pytest.raises(UsageError, match=says):
        read_case(tmp_path / name)


@pytest.mark.parametrize(
    ("name", "again"), [("cases/02-closest-hit.json", "./raysteps check 02"), ("cases/mine.json", "./raysteps check")]
)
def test_a_case_that_is_gone_leads_to_a_new_check(name: str, again: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["replay", f"nowhere/{name}"]) == 2
    said = capsys.readouterr().err
    assert f"nowhere/{name}: is not there: a check clears the cases of the one before" in said
    assert f"Type `{again}`, and then" in said


def test_a_missing_file_ends_with_2(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["replay", "no/such/case.json"]) == 2
    assert "no/such/case.json: is not there" in capsys.readouterr().err


@pytest.mark.parametrize("words", ["1 closest_hit 1 9 0 0 0 0 0 1", "1 closest_hit -1", "1 closest_hit 99999999"])
def test_lists_that_are_none(words: str) -> None:
    with pytest.raises(ProtocolError, match="surfaces: "):
        decode_inputs(functions_of("02")["closest_hit"], words)


# --- with programs ---


@pytest.mark.usefixtures("kit")
def test_right_wrong_and_otherwise_wrong(
    project: Project, solved: Sources, make_submission: MakeSubmission, tmp_path: Path
) -> None:
    wrong = solved["02-intersection"].replace(_NEARER, "to_closest + half_chord")
    miss = solved["02-intersection"].replace("half_chord_squared < 0.0F", "half_chord_squared > 0.0F")
    said = {}
    path = _write(tmp_path)
    for name, source in (("good", solved["02-intersection"]), ("wrong", wrong), ("miss", miss)):
        out = io.StringIO()
        folder = make_submission(name, {"02-intersection": source})
        code = replay(project, path, folder, Console(file=out, width=1000))
        said[name] = (code, out.getvalue())
    assert [code for code, _ in said.values()] == [0, 1, 1]
    good = said["good"][1]
    assert "02-intersection Sphere::intersect, a case of 'origin inside'" in good
    assert "ray: from (0, 0, 2) towards (0, 0, -1)" in good
    assert "now right" in good
    assert "distance 1 " in said["wrong"][1]
    assert "distance 3 " in said["wrong"][1]
    assert said["wrong"][1].endswith("still wrong: the distance is wrong\n")
    assert "none is reported (before: the distance is wrong)" in said["miss"][1]


@pytest.mark.usefixtures("kit")
def test_what_does_not_build(project: Project, make_submission: MakeSubmission, tmp_path: Path) -> None:
    folder = make_submission("broken", {"02-intersection": "this is no C++"})
    with pytest.raises(StudentBuildError, match=r"It does not build: intersection\.cpp:1:") as caught:
        replay(project, _write(tmp_path), folder, Console(file=io.StringIO()))
    assert caught.value.exit_code == 3


@pytest.mark.usefixtures("kit")
def test_a_step_that_was_not_handed_in(
    project: Project, solved: Sources, make_submission: MakeSubmission, tmp_path: Path
) -> None:
    folder = make_submission("other", {"01-camera-rays": solved["01-camera-rays"]})
    with pytest.raises(UsageError, match="intersection"):
        replay(project, _write(tmp_path), folder, Console(file=io.StringIO()))


@pytest.mark.usefixtures("kit")
def test_a_case_without_a_right_answer(
    project: Project, solved: Sources, make_submission: MakeSubmission, tmp_path: Path
) -> None:
    """Somebody changed the file by hand: not a fault of the kit."""
    line = _LINE.replace("0 0 0 1", "0 0 0 inf", 1)
    folder = make_submission("good", {"02-intersection": solved["02-intersection"]})
    with pytest.raises(UsageError, match="line: the reference has no right answer to it"):
        replay(project, _write(tmp_path, line=line), folder, Console(file=io.StringIO()))


def test_the_short_form_that_check_prints(
    kit: BuiltKit, project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A path below build/check; a file that is really there comes first."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UsageError, match=r"cases/02-nothing\.json: is not there"):
        replay(project, Path("cases/02-nothing.json"), None, Console(file=io.StringIO()))


def test_old_cases_are_cleared_and_nothing_else(steps: list[Step], tmp_path: Path) -> None:
    write_case(tmp_path / case_path("02", "closest_hit"), _CASE)
    clear_old_results(tmp_path, steps, steps)
    assert not (tmp_path / "cases").exists()
    write_case(tmp_path / case_path("02", "closest_hit"), _CASE)
    (tmp_path / "cases" / "02-notes.json").write_text("mine")
    clear_old_results(tmp_path, steps, steps)
    assert [path.name for path in (tmp_path / "cases").iterdir()] == ["02-notes.json"]


def test_the_file_of_a_graded_case(
    kit: BuiltKit, project: Project, solved: Sources, make_submission: MakeSubmission, tmp_path: Path
) -> None:
    """It is named in the results, and asked again it is wrong again; who must not see it does not get it."""
    source = solved["07-tone-mapping"].replace("std::lround(", "static_cast<int>(")
    folder = make_submission("ann", {"07-tone-mapping": source})
    submission = load_submission(folder, kit.steps)
    feedbacks: tuple[Feedback, ...] = ("full", "diagnosis", "score")
    for feedback in feedbacks:
        out = tmp_path / feedback
        settings = Settings(only=("07-tone-mapping",), feedback=feedback)
        grade_submission(kit, submission, settings, LimitsOnly(), out)
        (step,) = json.loads((out / "results.json").read_text("utf-8"))["steps"]
        named = [item["case"] for item in step["hidden"] if item["case"]]
        there = sorted(path.relative_to(out).as_posix() for path in out.rglob("cases/*"))
        assert named == there == (["cases/07-to-byte.json"] if feedback == "full" else [])
    assert replay(project, tmp_path / "full" / "cases/07-to-byte.json", folder, Console(file=io.StringIO())) == 1
