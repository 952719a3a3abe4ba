"""Grading on another system's machine, with an imitation of `grade` and of each system's folders."""

import json
import os
import subprocess
import sys
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from conftest import MakeSubmission, Sources
from export_documents import HOSTILE, mixed
from test_github import ENVIRONMENT

from raysteps.common.documents import as_text
from raysteps.common.process import Outcome
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.exports import hosted
from raysteps.exports import hosted as running
from raysteps.exports.autograders import classroom50_autograder
from raysteps.exports.formats import validate
from raysteps.exports.hosted import Options
from raysteps.results.model import Results

_OPTIONS = Options(60.0, words=("--seed", "7"))


class Grade:
    """Stands in for the process that runs `grade`."""

    def __init__(self, document: Results | None) -> None:
        self.document = document
        self.code = 1
        self.timed_out = False
        self.stderr = "raysteps: checking 01\n"
        self.words: list[str] = []

    def __call__(self, words: Sequence[str | Path], *, cwd: Path | None = None, **options: Any) -> Outcome:
        self.words = [str(word) for word in words]
        self.cwd = cwd
        if self.document is not None:
            out = Path(self.words[self.words.index("--out") + 1])
            (out / "results.json").write_text(as_text(self.document))
        return Outcome(self.code, self.timed_out, "secret table\n", self.stderr, 1.0)


@pytest.fixture
def grade(steps: list[Step], monkeypatch: pytest.MonkeyPatch) -> Grade:
    made = Grade(mixed(steps, HOSTILE))
    monkeypatch.setattr(hosted, "run", made)
    return made


@pytest.fixture
def root(tmp_path: Path, make_submission: MakeSubmission, unsolved: Sources) -> Path:
    """As /autograder and /grade."""
    make_submission("submission", unsolved)
    make_submission("student", unsolved)
    return tmp_path


def _results(root: Path) -> Any:
    return json.loads((root / "results" / "results.json").read_text())


def test_gradescope(project: Project, grade: Grade, root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (root / "submission_metadata.json").write_text('{"users": [{"name": "Ann"}, {"name": "Bob"}]}')
    assert running.gradescope(project, root, _OPTIONS, "visible") == 0
    results = _results(root)
    validate(results, "gradescope")
    assert results["output"].startswith("Submitted by Ann, Bob.\n")
    assert grade.words[:5] == [sys.executable, "-P", "-m", "raysteps", "grade"]
    assert grade.words[5] == str((root / "submission").resolve())
    assert grade.words[-4:] == ["--jobs", "1", "--seed", "7"]
    assert grade.cwd == project.root, "not where a student's files could be taken for modules"
    assert "secret table" not in capsys.readouterr().err


def test_what_grade_says_is_passed_on_only_where_no_student_reads_it(
    project: Project, grade: Grade, root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    running.gradescope(project, root, Options(60.0, echo=True), "visible")
    assert "secret table" in capsys.readouterr().err
    running.autolab(project, root / "submission", _OPTIONS)
    assert "secret table" not in str(capsys.readouterr())


@pytest.mark.parametrize("system", ["gradescope", "prairielearn"])
@pytest.mark.parametrize(
    ("break_it", "said"),
    [
        (lambda grade: setattr(grade, "code", 4), "no sandbox here"),
        (lambda grade: setattr(grade, "code", 2), "no sandbox here"),
        (lambda grade: setattr(grade, "code", -9), "no sandbox here"),
        (lambda grade: setattr(grade, "timed_out", True), "more than 1 minute;"),
        (lambda grade: setattr(grade, "document", None), "grade left no results"),
        (lambda grade: setattr(grade, "document", {"schema": "other"}), "grade left no results"),
    ],
)
def test_a_fault_gives_nobody_a_zero(
    project: Project, grade: Grade, root: Path, system: str, break_it: Callable[[Grade], None], said: str
) -> None:
    grade.stderr = "raysteps: checking 01\nraysteps: no sandbox here\n"
    break_it(grade)
    if system == "gradescope":
        assert running.gradescope(project, root, _OPTIONS, "visible") == 4
        results = _results(root)
        validate(results, "gradescope")
        assert said in results["output"]
        assert not any("score" in test for test in results["tests"])
    else:
        assert running.prairielearn(project, root, _OPTIONS) == 4
        results = _results(root)
        validate(results, "prairielearn")
        assert said in results["message"]
        assert results["gradable"] is False
    assert "score" not in results


def test_a_missing_submission_is_no_zero_either(project: Project, grade: Grade, tmp_path: Path) -> None:
    (tmp_path / "results").mkdir()
    assert running.gradescope(project, tmp_path, _OPTIONS, "visible") == 4
    assert "there is no submission" in _results(tmp_path)["output"]
    assert grade.words == []


def test_a_submission_without_steps_gets_zero_and_a_reason(project: Project, grade: Grade, tmp_path: Path) -> None:
    folder = tmp_path / "submission"
    folder.mkdir()
    (folder / "essay.txt").write_text("sorry")
    assert running.gradescope(project, tmp_path, Options(60.0, steps=("02", "04")), "visible") == 0
    results = _results(tmp_path)
    validate(results, "gradescope")
    assert [(test["score"], test["max_score"]) for test in results["tests"]] == [(0.0, 20.0), (0.0, 10.0)]
    assert "expected files like steps/" in results["tests"][0]["output"]
    assert str(tmp_path) not in json.dumps(results)
    assert grade.words == []


def test_a_damaged_archive_that_was_dropped_in_tells_no_folder(project: Project, grade: Grade, tmp_path: Path) -> None:
    (tmp_path / "submission").mkdir()
    (tmp_path / "submission" / "work.zip").write_bytes(b"PK\3\4 but no more")
    assert running.gradescope(project, tmp_path, _OPTIONS, "visible") == 0
    said = (tmp_path / "results" / "results.json").read_text(encoding="utf-8")
    assert "work.zip: cannot be read" in said
    assert str(tmp_path) not in said
    assert grade.words == []


def test_an_archive_that_was_dropped_in_is_found(
    project: Project, grade: Grade, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    tree = make_submission("ann", solved)
    folder = tmp_path / "submission"
    folder.mkdir()
    with zipfile.ZipFile(folder / "My Work.ZIP", "w") as archive:
        for path in tree.rglob("*.cpp"):
            archive.write(path, path.relative_to(tree))
    (folder / "readme.txt").write_text("see the zip")
    assert running.gradescope(project, tmp_path, _OPTIONS, "visible") == 0
    assert grade.words[5] == str(folder.resolve())  # `grade` finds it there


def test_autolab(project: Project, grade: Grade, root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert running.autolab(project, root / "submission", _OPTIONS) == 0
    lines = capsys.readouterr().out.splitlines()
    validate([json.loads(line) for line in lines[-2:]], "autolab")
    grade.code = 4
    assert running.autolab(project, root / "submission", _OPTIONS) == 4
    assert capsys.readouterr().out == ""


def test_classroom50(
    project: Project, grade: Grade, root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, value in ENVIRONMENT.items():
        monkeypatch.setenv(name, value)
    out = root / "result.json"
    grade.code = 4
    grade.stderr = "raysteps: what ##[error]he said\n"
    for handed_in in ("file", "folder", "link"):
        if handed_in == "file":
            out.write_text('{"score": 110}')
        elif handed_in == "folder":
            (out / "deep").mkdir(parents=True)
        else:
            out.symlink_to(root / "submission")
        assert running.github(project, root / "submission", _OPTIONS, out, legacy=False) == 4
        assert not out.exists()
        assert not out.is_symlink()
    assert (root / "submission").is_dir()
    assert "what # #[error]he said" in capsys.readouterr().err
    grade.code = 3
    assert running.github(project, root / "submission", _OPTIONS, out, legacy=False) == 0
    validate(json.loads(out.read_text()), "classroom50")
    assert running.github(project, root / "submission", _OPTIONS, None, legacy=False) == 4, "nowhere to write to"


def test_the_autograder_of_classroom50_calls_the_kit(tmp_path: Path) -> None:
    """Under `python -P`-less rules: what lies in the student's checkout must not be imported."""
    bundle, checkout = tmp_path / "bundle", tmp_path / "checkout"
    (bundle / "kit").mkdir(parents=True)
    checkout.mkdir()
    (checkout / "result.json").write_text('{"score": 110}')
    (bundle / "autograder.py").write_bytes(classroom50_autograder(["--minutes", "5"]))
    (bundle / "kit" / "raysteps").write_text('printf "%s\\n" "$PWD" "$@" >"$OUT"\nexit 4\n')
    (checkout / "subprocess.py").write_text("raise SystemExit('imported from the checkout')")
    environment = {**os.environ, "OUT": str(tmp_path / "said"), "RAYSTEPS_KIT": str(tmp_path / "no")}
    command: list[str | Path] = [sys.executable, bundle / "autograder.py"]
    done = subprocess.run(command, cwd=checkout, env=environment, check=False)
    assert done.returncode == 4
    assert not (checkout / "result.json").exists()
    place, *words = (tmp_path / "said").read_text().splitlines()
    assert place == str(bundle / "kit")
    out = str(checkout / "result.json")
    assert words == ["export", "classroom50", "--run", str(checkout), "--out", out, "--minutes", "5"]
