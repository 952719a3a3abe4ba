"""Every export as its system would run and read it: unpacked into an empty folder, with a good, a partly right, a
broken and a hostile submission, and with a fault of the grader. The grading itself is played: `grade` of the unpacked
kit hands out results that were made by hand. How systems read is in helpers/platforms.py."""

import html
import io
import json
import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import platforms
import pytest
from export_documents import HOSTILE, document, full, mixed
from PIL import Image
from platforms import Shown
from test_github import ENVIRONMENT

from raysteps.common.documents import as_text
from raysteps.common.markdown import prose
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.exports.autograders import (
    Member,
    as_tar,
    autolab_tar,
    classroom50_autograder,
    gradescope_zip,
    into_folder,
    prairielearn_course,
)
from raysteps.exports.github import release_assets
from raysteps.play.packages import extract
from raysteps.results.model import Results, StepResult

pytestmark = pytest.mark.xdist_group("platforms")

_WORDS = ["--minutes", "9", "--seed", "7"]
_WORSE = HOSTILE + '\n````\n# a heading\n=HYPERLINK(1)\n{"scores": {"01-camera-rays": 99}}'
_PLAYED = """
import os, shutil, sys
from pathlib import Path
from raysteps.common.errors import GraderFault

def seconds_at_most(words):
    return 600

def add_arguments(parser):
    parser.add_argument("submission")
    parser.add_argument("--out", type=Path)
    for option in ("--jobs", "--seed"):
        parser.add_argument(option)

def run(project, arguments, console):
    graded = Path(os.environ["PLAYED"])
    if not (graded / "results.json").is_file():
        raise GraderFault("no sandbox here")
    shutil.copytree(graded, arguments.out, dirs_exist_ok=True)
    return 1
"""
_RAYSTEPS = '#!/bin/sh\nPYTHONPATH=$(dirname "$0")/grader/src exec "$RAYSTEPS_VENV/bin/python" -P -m raysteps "$@"\n'
KINDS = ("good", "partial", "broken", "hostile", "fault")


def _broken(steps: list[Step]) -> Results:
    said = "shadows.cpp:7: error: expected ';'"
    return document(
        [
            StepResult(
                step.id, "does-not-build", 0.0, step.points, step.bonus, messages=["It does not build."], build_log=said
            )
            for step in steps
        ]
    )


def _graded(steps: list[Step]) -> dict[str, Results]:
    return {"good": full(steps), "partial": mixed(steps), "broken": _broken(steps), "hostile": mixed(steps, _WORSE)}


def _play(results: Results, folder: Path) -> None:
    """What `grade` leaves: results.json, with the pictures beside it."""
    (folder / "pictures").mkdir(parents=True)
    for step in results.steps:
        for image in step.images:
            image.mine = image.reference = f"pictures/{step.id}-{image.name}.png"
            Image.new("RGB", (160, 120), (90, 9, 9)).save(folder / image.mine)
    (folder / "results.json").write_text(as_text(results), encoding="utf-8")


@dataclass
class Stage:
    """The kit as it was unpacked, with a `grade` that is played, and what it hands out."""

    kit: Path
    played: Path
    folder: Path

    def environment(self, kind: str, **more: str) -> dict[str, str]:
        kept = {name: value for name, value in os.environ.items() if not name.startswith(("GITHUB_", "RAYSTEPS_"))}
        known = {"RAYSTEPS_VENV": sys.prefix, "RAYSTEPS_KIT": str(self.kit), "PLAYED": str(self.played / kind)}
        return {**kept, **known, **more}

    def root(self, name: str) -> Path:
        root = self.folder / name
        shutil.rmtree(root, ignore_errors=True)
        root.mkdir()
        return root


@pytest.fixture(scope="module")
def stage(project: Project, steps: list[Step], tmp_path_factory: pytest.TempPathFactory) -> Stage:
    folder = tmp_path_factory.mktemp("platforms")
    with zipfile.ZipFile(io.BytesIO(gradescope_zip(project, _WORDS))) as archive:
        for info in archive.infolist():
            Path(archive.extract(info, folder / "source")).chmod(info.external_attr >> 16 & 0o777)
    kit = folder / "source" / "kit"
    (kit / "grader" / "src" / "raysteps" / "cli" / "grade.py").write_text(_PLAYED)
    (kit / "raysteps").write_text(_RAYSTEPS)
    for kind, results in _graded(steps).items():
        _play(results, folder / "played" / kind)
    (folder / "autolab.tar").write_bytes(autolab_tar(project, _WORDS, steps))
    into_folder(prairielearn_course(project, _WORDS, steps, [], "me/raysteps"), folder / "course")
    with tarfile.open(folder / "course" / "serverFilesCourse" / "raysteps" / "kit.tar", "w:xz") as archive:
        archive.add(kit, "kit")  # as prepare.sh packs it
    return Stage(kit, folder / "played", folder)


def _hand_in(folder: Path, steps: list[Step]) -> None:
    for step in steps:
        (folder / step.path).parent.mkdir(parents=True, exist_ok=True)
        (folder / step.path).write_text("// mine\n")


def _run(command: list[str | Path], cwd: Path, environment: Mapping[str, str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command, cwd=cwd, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )


# Each runs one kind of submission and returns what would be seen.


def _gradescope(stage: Stage, steps: list[Step], kind: str) -> Shown:
    root = stage.root("autograder")
    (root / "source").symlink_to(stage.folder / "source")
    shutil.copy(root / "source" / "run_autograder", root)
    _hand_in(root / "submission", steps)
    _run([root / "run_autograder"], root, stage.environment(kind, RAYSTEPS_AUTOGRADER=str(root)))
    return platforms.gradescope(root)


def _classroom50(stage: Stage, steps: list[Step], kind: str) -> Shown:
    root, bundle = stage.root("checkout"), stage.root("bundle")
    (bundle / "autograder.py").write_bytes(classroom50_autograder(_WORDS))
    _hand_in(root, steps)
    (root / "raysteps-report").symlink_to(stage.folder)
    (root / "release-body.md").write_text("110 of 110, believe me")
    assets = json.dumps(release_assets(step.id for step in steps))
    environment = stage.environment(kind, **ENVIRONMENT, RELEASE_ASSETS=assets)
    done = _run([sys.executable, bundle / "autograder.py"], root, environment)
    shown = platforms.classroom50(root, done.returncode, environment)
    assert not any(line.lstrip().startswith("::") or "##[" in line for line in done.stdout.splitlines())
    assert "believe me" not in "".join(path.read_text() for path in root.glob("release-body.md"))
    return shown


def _legacy(stage: Stage, steps: list[Step], kind: str) -> Shown:
    root = stage.root("workspace")
    _hand_in(root / "submission", steps)
    environment = stage.environment(kind, GITHUB_OUTPUT=str(root / "output"))
    words: list[str | Path] = ["export", "classroom50", "--legacy", "--run", root / "submission", *_WORDS]
    done = _run(["sh", stage.kit / "raysteps", *words], root, environment)
    assert not any(line.lstrip().startswith("::") or "##[" in line for line in done.stdout.splitlines())
    return platforms.legacy(root / "output", done.returncode)


def _autolab_output(stage: Stage, steps: list[Step], kind: str, **more: str) -> str:
    root = stage.root("autolab")
    with tarfile.open(stage.folder / "autolab.tar") as archive:
        extract(archive, root)
    (root / "autograde-Makefile").rename(root / "Makefile")
    (root / "hooks.rb").unlink()
    with zipfile.ZipFile(root / "handin.zip", "w") as handin:
        for step in steps:
            handin.writestr(step.path.as_posix(), "// mine\n")
    return _run(["make"], root, stage.environment(kind, **more)).stdout


def _autolab(stage: Stage, steps: list[Step], kind: str) -> Shown:
    output = _autolab_output(stage, steps, kind)
    problems = {step.id: step.points for step in steps}
    shown, entered = platforms.autolab(output, problems, hooks=True)
    assert set(entered) == (set() if kind == "fault" else set(problems))
    _, without = platforms.autolab(output, problems, hooks=False)
    assert kind != "fault" or set(without.values()) == {None}
    return shown


def _prairielearn(stage: Stage, steps: list[Step], kind: str) -> Shown:
    root = stage.root("grade")
    shutil.copytree(stage.folder / "course" / "serverFilesCourse", root / "serverFilesCourse")
    shutil.copytree(root / "serverFilesCourse", root / "shared")
    info = json.loads((stage.folder / "course" / "questions" / "raysteps" / "info.json").read_text())
    (root / "student").mkdir()
    for step in steps:
        (root / "student" / step.file).write_text("// mine\n")
    first, *words = info["externalGradingOptions"]["entrypoint"]
    kit = stage.folder / "opt" / "raysteps" / "kit"
    shutil.rmtree(kit, ignore_errors=True)
    environment = stage.environment(kind, RAYSTEPS_GRADE=str(root), RAYSTEPS_KIT=str(kit))
    done = _run([root / Path(first).relative_to("/grade"), *words], root, environment)
    for folder in ("serverFilesCourse", "shared"):
        assert (root / folder).stat().st_mode & 0o077 == 0, "the solutions are in it"
    assert kit.stat().st_mode & 0o077 == 0
    return platforms.prairielearn(root, done.returncode)


def _class(stage: Stage, kind: str) -> Path:
    """As grade-class leaves it, for two students: a fault of the grader leaves no points."""
    graded = stage.root("graded")
    rows = ["submission,id,name,email,points,max,late_points,extra"]
    for name, number, what in (("Ann Lee", "S1", kind), ("Bob Ray", "S2", "partial")):
        points = ""
        if what != "fault":
            shutil.copytree(stage.played / what, graded / "submissions" / number)
            points = json.loads((graded / "submissions" / number / "results.json").read_text())["total"]["points"]
        rows.append(f"{number},{number},{name},{number}@uni.edu,{points},100,,")
    (graded / "results.csv").write_text("\n".join(rows) + "\n")
    return graded


def _filled(stage: Stage, system: str, kind: str, template: str) -> str:
    graded, root = _class(stage, kind), stage.root(system)
    (root / "template.csv").write_text(template)
    words: list[str | Path] = ["export", system, "--template", "template.csv", "--results", graded, "--out", "out.csv"]
    done = _run(["sh", stage.kit / "raysteps", *words], root, stage.environment(kind))
    assert done.returncode == 0, done.stdout
    return (root / "out.csv").read_text()


def _canvas(stage: Stage, steps: list[Step], kind: str) -> Shown:
    people = "Ann,101,S1,ann,A,\nBob,102,S2,bob,A,\n"
    template = f"Student,ID,SIS User ID,SIS Login ID,Section,Raysteps (12)\n    Points Possible,,,,,100.00\n{people}"
    return platforms.gradebook(_filled(stage, "canvas", kind, template), "Raysteps (12)", "SIS User ID", "S1")


def _moodle(stage: Stage, steps: list[Step], kind: str) -> Shown:
    heading = (
        "Identifier,Full name,ID number,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
        "Last modified (submission),Last modified (grade),Feedback comments"
    )
    people = "".join(f"Participant 10{n},x,S{n},s{n}@uni.edu,,,100.00,Yes,-,-,\n" for n in (1, 2))
    text = _filled(stage, "moodle", kind, f"{heading}\n{people}")
    return platforms.gradebook(text, "Grade", "ID number", "S1", "Feedback comments")


SYSTEMS: dict[str, Callable[[Stage, list[Step], str], Shown]] = {
    "gradescope": _gradescope,
    "classroom50": _classroom50,
    "classroom50 --legacy": _legacy,
    "autolab": _autolab,
    "prairielearn": _prairielearn,
    "canvas": _canvas,
    "moodle": _moodle,
}
_MAX = {"prairielearn": 100, "canvas": None, "moodle": None}  # of the others: 120, with the bonus
_WHOLE = ("classroom50", "classroom50 --legacy")
_NO_TEXT = ("canvas",)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("system", SYSTEMS)
def test_what_a_student_sees(stage: Stage, steps: list[Step], system: str, kind: str) -> None:
    shown = SYSTEMS[system](stage, steps, kind)
    if kind == "fault":
        assert shown.points is None, "a fault of the grader is no zero"
        if system in ("gradescope", "autolab", "prairielearn"):
            assert "no sandbox here" in shown.text
            assert "tell your instructors" in shown.text
        return
    points = _graded(steps)[kind].total.points
    if system in _WHOLE:
        points = int(points + 0.5)
    assert shown.points == (min(points, 100) if system == "moodle" else points)
    assert shown.most == _MAX.get(system, 120)
    if system in _NO_TEXT:
        return
    if kind == "broken":
        assert "It does not build." in html.unescape(shown.text)
        assert "expected ';'" in html.unescape(shown.text)
    if kind in ("partial", "hostile") and system in ("gradescope", "classroom50", "prairielearn"):
        assert shown.pictures > 0
    if kind == "hostile":
        assert "evil" in shown.text
        assert not any((ord(letter) < 32 and letter not in "\n\t") or letter == "\u202e" for letter in shown.text)
        if system == "moodle":
            assert "<script" not in shown.text
        if system == "classroom50":
            assert "script" not in prose(shown.text)


_SCRIPT_FAULTS = ("gradescope", "classroom50", "classroom50 --legacy", "autolab", "prairielearn")


@pytest.mark.parametrize("system", _SCRIPT_FAULTS)
def test_a_kit_that_does_not_even_start_gives_nobody_a_zero(stage: Stage, steps: list[Step], system: str) -> None:
    """Where the package itself cannot speak, the scripts around it do."""
    broken = Stage(stage.kit, stage.played, stage.folder)
    environment = broken.environment
    broken.environment = lambda kind, **more: environment(kind, **{**more, "RAYSTEPS_VENV": "/nowhere"})  # type: ignore[method-assign]
    shown = SYSTEMS[system](broken, steps, "fault")
    assert shown.points is None
    if system in ("gradescope", "autolab", "prairielearn"):
        assert "tell your instructors" in shown.text


@pytest.mark.parametrize("gone", ["autograde.tar", "handin.zip", "driver.sh"])
def test_whatever_is_missing_autolab_enters_no_zero(stage: Stage, steps: list[Step], gone: str) -> None:
    root = stage.root("autolab-incomplete")
    with tarfile.open(stage.folder / "autolab.tar") as archive:
        extract(archive, root)
    (root / "autograde-Makefile").rename(root / "Makefile")
    (root / "hooks.rb").unlink()
    if gone == "driver.sh":
        (root / "autograde.tar").write_bytes(as_tar([Member("raysteps-autolab/setup.sh", b"", executable=True)]))
    elif gone == "autograde.tar":
        (root / gone).unlink()
    done = _run(["make"], root, stage.environment("good"))
    assert done.returncode == 0, "make would add a line of its own"
    problems = {step.id: step.points for step in steps}
    shown, entered = platforms.autolab(done.stdout, problems, hooks=False)
    assert set(entered.values()) == {None}
    assert shown.points is None


def test_the_readers_know_a_zero(steps: list[Step], tmp_path: Path) -> None:
    """What the former exports left would not pass."""
    problems = {step.id: step.points for step in steps}
    for output in ("", "The autograder itself failed.\n", '{"scores": {}}', "make: *** [Makefile:6: all] Error 4"):
        assert set(platforms.autolab(output, problems, hooks=False)[1].values()) == {0.0}
        assert platforms.autolab(output, problems, hooks=True)[1] in ({}, dict.fromkeys(problems, 0.0))
    assert "Unknown error" in platforms.prairielearn(tmp_path, 4).text
