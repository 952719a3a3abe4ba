"""A step of an instructor's own, from `dev new` to the grade; the manifests of a course that is changed."""

import argparse
import json
import re
import shutil
import sys
from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import kit_steps, read_all_steps, read_steps
from raysteps.course.mutants import read_mutants, reference_source
from raysteps.course.project import Project
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.course.stubs import outdated_stubs
from raysteps.exports.autograders import kit_files
from tools import dev as maintenance
from tools import new_step as command
from tools.test_submissions import outdated_samples

_SECONDS = 900


@pytest.fixture
def copy(project: Project, tmp_path: Path) -> Project:
    """The kit without its grader's code: what the manifests tell."""
    root = tmp_path / "kit"
    for name in ("steps", "solutions", "grader/samples"):
        shutil.copytree(project.root / name, root / name, ignore=shutil.ignore_patterns("__pycache__"))
    return Project(root)


def _new(project: Project, *words: str) -> int:
    parser = argparse.ArgumentParser()
    command.add_arguments(parser.add_subparsers())
    return command.run(project, parser.parse_args(["new", *words]))


def _change(project: Project, step: str, old: str, new: str) -> None:
    path = project.steps / step / "step.toml"
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("fog", "expected two digits and words of small letters"),
        ("10_fog", "such as 20-fog"),
        ("20-Fog", "such as 20-fog"),
        ("20-" + "a" * 60, "at most 40 characters"),
        ("05-fog", "05-reflection has this number already; the next one is 20-fog"),
        ("21-fog", "new steps of part 1 count on from 20; expected 20-fog"),
        ("20-shadows", "04-shadows has this name already"),
        ("20-con", "Windows has no files called con"),
    ],
)
def test_a_name_that_cannot_be_is_refused(copy: Project, name: str, words: str) -> None:
    with pytest.raises(UsageError, match=re.escape(words)):
        _new(copy, name)
    assert len(read_steps(copy)) == 9


def test_a_folder_that_is_there_is_not_written_over(copy: Project) -> None:
    (copy.solutions / "20-fog").mkdir()
    with pytest.raises(UsageError, match="is there already"):
        _new(copy, "20-fog")


def test_everything_that_is_made_from_a_step_is_made(copy: Project, capsys: pytest.CaptureFixture[str]) -> None:
    assert _new(copy, "20-thin-fog", "--title", 'Fog, "thin"', "--points", "2.5", "--bonus") == 0
    step = read_steps(copy)[-1]
    assert (step.id, step.title, step.points, step.bonus) == ("20-thin-fog", 'Fog, "thin"', 2.5, True)
    assert not outdated_stubs(copy, read_steps(copy))
    assert not outdated_samples(copy, read_steps(copy))
    for mutant in read_mutants(copy, step):
        mutant.applied(reference_source(copy, step))
    left = [path for room in (copy.steps, copy.solutions) for path in (room / step.id).rglob("*") if path.is_file()]
    assert not [path for path in left if re.search(r"@[A-Z]+@", path.read_text(encoding="utf-8") + path.name)]
    assert "dev check --only 20" in capsys.readouterr().out


def test_a_step_of_part_two_has_a_number_of_its_own(copy: Project) -> None:
    numbers = [step.index for step in read_all_steps(copy) if step.index in range(10, 20)]
    following = max([9, *numbers]) + 1
    with pytest.raises(UsageError, match=f"new steps of part 2 count on from 10; expected {following}-mist"):
        _new(copy, "20-mist", "--part", "2")
    assert _new(copy, f"{following}-mist", "--part", "2") == 0
    step = next(step for step in kit_steps(copy) if step.id.endswith("-mist"))
    assert (step.index, step.part) == (following, 2)
    assert step not in read_steps(copy)
    assert _new(copy, "20-fog") == 0
    assert [(step.id, step.part) for step in read_steps(copy)[9:]] == [("20-fog", 1)]
    assert not outdated_stubs(copy, kit_steps(copy))
    assert not outdated_samples(copy, kit_steps(copy))


def test_a_part_may_have_no_number_left(copy: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(command._NUMBERS, 2, range(10, max(step.index for step in kit_steps(copy)) + 1))
    with pytest.raises(UsageError, match="part 2 has no number left; its steps are 10 to "):
        command.check_name(copy, "20-mist", 2)


def test_what_is_still_the_samples_is_named_until_it_is_replaced(
    copy: Project, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _new(copy, "20-glow") == 0
    said = capsys.readouterr().out
    for words in ("about fog", "alternatives/in-doubles.cpp", "[20-glow][glow_color]", "balls-glow", "glass.nff"):
        assert words in said
    step = read_steps(copy)[-1]
    left = command.sample_leftovers(copy, step)
    for file in ("steps/20-glow/README.md", "steps/20-glow/step.toml", "steps/20-glow/glow.hpp",
                 "steps/20-glow/glow_test.cpp", "solutions/20-glow/mutants.toml",
                 "solutions/20-glow/alternatives/in-doubles.cpp"):  # fmt: skip
        assert [line for line in left if line.startswith(f"{file}:")], file
    readme = copy.steps / step.id / "README.md"
    number = int(next(line for line in left if "README.md" in line).split(":")[1])
    lines = readme.read_text(encoding="utf-8").splitlines()
    assert re.search("air|far away", lines[number - 1])
    readme.write_text("# Step 10: Glow\n\nYou edit one file: `glow.cpp`.\n", encoding="utf-8")
    assert not [line for line in command.sample_leftovers(copy, step) if "README.md" in line]


def test_the_kits_own_steps_have_nothing_of_the_sample(project: Project) -> None:
    assert [line for step in kit_steps(project) for line in command.sample_leftovers(project, step)] == []


def test_a_step_that_is_taken_away_leaves_nothing(copy: Project, capsys: pytest.CaptureFixture[str]) -> None:
    _new(copy, "20-fog")
    for room in (copy.steps, copy.solutions):
        shutil.rmtree(room / "20-fog")
    assert maintenance.samples(copy, check=True) == 1
    assert "20-fog belongs to no step" in capsys.readouterr().out
    assert maintenance.stubs(copy, check=False) == maintenance.samples(copy, check=False) == 0
    assert not list(copy.root.rglob("20-fog"))
    assert maintenance.stubs(copy, check=True) == maintenance.samples(copy, check=True) == 0


def test_points_and_weights_are_the_manifests(copy: Project) -> None:
    _change(copy, "04-shadows", "points = 10", "points = 25")
    _change(copy, "04-shadows", "tests = 0.5", "tests = 0.6")
    with pytest.raises(GraderFault, match="the weights must sum to 1"):
        read_steps(copy)
    _change(copy, "04-shadows", "hidden = 0.35", "hidden = 0.25")
    step = read_steps(copy)[3]
    assert (step.points, step.weight_tests, step.weight_hidden) == (25, 0.6, 0.25)


def test_a_step_that_is_left_out_is_built_and_not_part_of_the_course(copy: Project) -> None:
    _change(copy, "05-reflection", "bonus = false", "bonus = false\nleft_out = true")
    assert [step.number for step in read_steps(copy)] == ["01", "02", "03", "04", "06", "07", "08", "09"]
    assert set(read_all_steps(copy)) - set(kit_steps(copy)) == {read_all_steps(copy)[4]}


def test_a_picture_that_cmake_would_not_find_is_refused(copy: Project) -> None:
    _new(copy, "20-fog")
    _change(copy, "20-fog", 'picture = "', "picture='")
    _change(copy, "20-fog", 'fog_picture"', "fog_picture'")
    with pytest.raises(GraderFault, match='expected a line like `picture = "fog_picture"`'):
        read_steps(copy)


def test_two_steps_with_one_number_are_the_kits_fault(copy: Project) -> None:
    shutil.copytree(copy.steps / "09-bvh", copy.steps / "09-fog")
    _change(copy, "09-fog", 'id = "09-bvh"', 'id = "09-fog"')
    with pytest.raises(GraderFault, match="two steps have the number 09"):
        read_steps(copy)


def _raysteps(root: Path, *words: str | Path) -> Outcome:
    return run([sys.executable, "-m", "raysteps", *words], seconds=_SECONDS, cwd=root)


@pytest.mark.slow
def test_a_new_step_is_graded_and_shown_and_no_other_file_is_edited(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = tmp_path / "kit"
    monkeypatch.setenv("PYTHONPATH", str(root / "grader" / "src"))
    for file in kit_files(project):
        path = root / file.place
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file.source, path)
    shutil.copytree(project.root / "tools", root / "tools")
    assert _raysteps(root, "dev", "new", "20-fog", "--points", "12").code == 0
    _change(Project(root), "05-reflection", "bonus = false", "bonus = false\nleft_out = true")
    _change(Project(root), "20-fog", "points = 12", "part = 2\npoints = 12")
    assert "20-fog belongs to part 2" in _raysteps(root, "check", "20").stderr
    (tmp_path / "course.toml").write_text("parts = [1, 2]\n")
    monkeypatch.setenv(COURSE_VARIABLE, str(tmp_path / "course.toml"))

    complete, partial = (root / "grader/samples" / name for name in ("complete", "partial"))
    outcome = _raysteps(root, "grade", complete, "--out", tmp_path / "right", "--only", "6", "20", "--jobs", "2")
    assert outcome.code == 0, outcome.stdout + outcome.stderr
    octree, fog = json.loads((tmp_path / "right" / "results.json").read_text("utf-8"))["steps"]
    assert (octree["status"], fog["status"], fog["points"]) == ("passed", "passed", 12)
    assert [item["kind"] for item in fog["hidden"]] == ["function", "picture"]
    assert "balls-fog" in (tmp_path / "right" / "report.html").read_text("utf-8")
    _raysteps(root, "grade", partial, "--out", tmp_path / "stub", "--only", "20")
    (fog,) = json.loads((tmp_path / "stub" / "results.json").read_text("utf-8"))["steps"]
    assert (fog["status"], fog["points"]) == ("not-started", 0)

    outcome = _raysteps(root, "gallery", "--scene", "three-spheres", "--size", "32x24", "--out", tmp_path / "gallery")
    assert outcome.code == 0, outcome.stdout + outcome.stderr
    page = (tmp_path / "gallery" / "index.html").read_text("utf-8")
    assert "what is far away fades into its colour" in page
    assert "A mirrored ray is traced" not in page

    wrong = partial / "steps/20-fog/fog.cpp"
    step = read_steps(Project(root))[-1]
    wrong.write_text(read_mutants(Project(root), step)[0].applied(reference_source(Project(root), step)))
    _raysteps(root, "grade", partial, "--out", tmp_path / "wrong", "--only", "20")
    (fog,) = json.loads((tmp_path / "wrong" / "results.json").read_text("utf-8"))["steps"]
    assert fog["points"] < 12
    assert fog["diagnoses"][0]["id"] == "shares-swapped"
