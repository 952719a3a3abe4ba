"""A kit of two courses: which steps belong to the one that course.toml chooses."""

import io
import re
import shutil
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from course_fakes import printed, small_project, text

from raysteps.cli import app as cli
from raysteps.cli.todo_steps import last_written, unfinished, wanted_step, without_tree
from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.manifest import (
    Step,
    chosen_step,
    chosen_steps,
    course_steps,
    dated_steps,
    earlier,
    kit_steps,
    read_all_steps,
    read_step,
    read_steps,
    steps_words,
)
from raysteps.course.project import Project, here
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.exports.autograders import gradescope_zip
from raysteps.progress.standing import list_steps
from raysteps.release import build_release
from raysteps.release.build_release import first_steps, written_files

_SECOND = ("08-refraction", "09-bvh")  # as if these were a part two


def _part_one(project: Project) -> list[Step]:
    return [step for step in read_all_steps(project) if step.part == 1]


@pytest.fixture
def kit(project: Project, tmp_path: Path) -> Project:
    """Manifests only, as the whole kit has them."""
    copy = Project(tmp_path / "kit")
    for step in _part_one(project):
        for room in (copy.steps, copy.solutions):
            (room / step.id).mkdir(parents=True)
        shutil.copy(project.steps / step.id / "step.toml", copy.steps / step.id)
        shutil.copy(project.solutions / step.path, copy.solutions / step.path)
        shutil.copy(project.steps / step.path, copy.steps / step.path)
    for name in _SECOND:
        _add(copy, name, "part = 2")
    return copy


@pytest.fixture
def settle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Path]:
    """Writes course.toml."""

    def write(said: str) -> Path:
        place = tmp_path / "course.toml"
        place.write_text(said)
        monkeypatch.setenv(COURSE_VARIABLE, str(place))
        return place

    return write


def _add(kit: Project, step: str, line: str) -> None:
    path = kit.steps / step / "step.toml"
    path.write_text(re.sub(r"^points = ", f"{line}\npoints = ", path.read_text("utf-8"), flags=re.MULTILINE), "utf-8")


def _numbers(steps: list[Step]) -> str:
    return "".join(str(step.index) for step in steps)


def test_a_step_belongs_to_part_one_unless_it_says_otherwise(kit: Project) -> None:
    assert [step.part for step in kit_steps(kit)] == [1] * 7 + [2] * 2


@pytest.mark.parametrize("value", ["0", "10", '"2"', "1.0", "true"])
def test_a_part_is_a_number(kit: Project, value: str) -> None:
    _add(kit, "01-camera-rays", f"part = {value}")
    with pytest.raises(GraderFault, match="part: expected a whole number from 1 to 9; found"):
        read_step(kit.steps / "01-camera-rays" / "step.toml")


@pytest.mark.parametrize(
    ("said", "numbers"),
    [
        ("", "1234567"),
        ("parts = [1]", "1234567"),
        ("parts = [2]", "89"),
        ("parts = [2, 1, 2]", "123456789"),
        ('parts = [1, 2]\nsteps = "7-8"', "78"),
        ('parts = [2]\nsteps = "9"', "9"),
    ],
)
def test_a_course_has_the_steps_of_its_parts(
    kit: Project, settle: Callable[[str], Path], said: str, numbers: str
) -> None:
    settle(said)
    assert _numbers(course_steps(kit)) == numbers
    assert _numbers(kit_steps(kit)) == "123456789"  # those who make the kit go over all


def test_what_is_left_out_stays_out_of_its_part(kit: Project, settle: Callable[[str], Path]) -> None:
    _add(kit, "08-refraction", "left_out = true")
    settle("parts = [1, 2]")
    assert _numbers(read_steps(kit)) == "12345679"
    said = r"^step 08-refraction is left out: steps/08-refraction/step.toml says `left_out = true`$"
    for name in ("8", "08-refraction", "1-8"):
        with pytest.raises(UsageError, match=said):
            chosen_steps(kit, [name])
    place = settle('parts = [1, 2]\nsteps = "1-8"')
    with pytest.raises(UsageError, match=re.escape(f"{place}:2:1: steps: step 08-refraction is left out")):
        course_steps(kit)
    with pytest.raises(UsageError, match=r"there is no step '12'\. The steps are [^;]*09-bvh$"):
        chosen_steps(kit, ["12"])


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("parts = []", ":1:1: parts: expected a list of the kit's parts, such as [1, 2]; found []"),
        ("parts = 2", ":1:1: parts: expected a list of the kit's parts, such as [1, 2]; found 2"),
        ('seed = 1\nparts = [1, "2"]', ":2:1: parts: expected a list"),
        ("parts = [0]", ":1:1: parts: expected a list"),
        ("parts = [true]", ":1:1: parts: expected a list"),
        (
            'title = "x"\n parts = [1, 3]',
            ":2:2: parts: the kit has no steps of part 3; it has those of part 1 and part 2",
        ),
        (
            'steps = "1-8"',
            ":1:1: steps: step 08-refraction belongs to part 2; `parts = [1, 2]` in course.toml takes it in",
        ),
        ('parts = [2]\nsteps = "1"', ":2:1: steps: step 01-camera-rays belongs to part 1; `parts = [1, 2]`"),
    ],
)
def test_a_wrong_choice_is_refused_where_it_stands(
    kit: Project, settle: Callable[[str], Path], said: str, words: str
) -> None:
    place = settle(said)
    with pytest.raises(UsageError, match=re.escape(f"{place}{words}")):
        course_steps(kit)


def test_dates_are_of_the_parts_that_are_chosen(kit: Project, settle: Callable[[str], Path]) -> None:
    days = '[steps]\n"1-7" = 2026-10-12\n"8-9" = 2026-11-02\n'
    place = settle(days)
    with pytest.raises(UsageError, match=re.escape(f"{place}:3:1: steps: step 08-refraction belongs to part 2")):
        dated_steps(kit)
    settle(f"parts = [1, 2]\n{days}")
    assert _numbers([step for step, _ in dated_steps(kit)]) == "123456789"


@pytest.mark.parametrize("name", ["8", "08", "08-refraction", "8-9"])
def test_a_step_of_another_part_is_refused_by_name(kit: Project, settle: Callable[[str], Path], name: str) -> None:
    settle("parts = [1]")
    for choose in (chosen_step, lambda kit, name: chosen_steps(kit, [name])):
        with pytest.raises(UsageError, match=r"^step 08-refraction belongs to part 2; `parts = \[1, 2\]` in course"):
            choose(kit, name)
    with pytest.raises(UsageError, match=r"there is no step '12'\. The steps are .*07-tone-mapping; part 2 has 08-"):
        chosen_steps(kit, ["12"])
    with pytest.raises(UsageError, match=r"08-refraction, .*`parts = \[1, 2\]` in course.toml takes it in$"):
        chosen_steps(kit, ["12"])
    settle("parts = [2]")
    assert _numbers(chosen_steps(kit, [name])) in ("8", "89")


def test_what_students_were_given_is_theirs(tmp_path: Path) -> None:
    """Their kit has no course.toml: it has the parts that were given out."""
    course = small_project(tmp_path)
    for name in _SECOND:
        _add(course, name, "part = 2")
    assert _numbers(read_steps(course)) == "123456789"
    assert {"Part 1 | 64.6", "Part 2 | 0 | and up to 13 more as a bonus"} <= set(_listed(course))


def _listed(kit: Project) -> list[str]:
    console = printed()
    assert list_steps(kit, console) == 0
    return [re.sub(r" {2,}", " | ", line.strip()) for line in text(console).splitlines()]


def test_the_list_shows_all_parts_and_how_to_get_them(kit: Project, settle: Callable[[str], Path]) -> None:
    settle("parts = [1]")
    lines = _listed(kit)
    assert "Part 1 | 100" in lines
    assert "→ | 01 | Camera rays | 10 | not started" in lines
    assert "Part 2 | 0 | `parts = [1, 2]` in course.toml takes it in" in lines
    assert "09 | Bounding volumes (bonus) | 10 | not in this course" in lines
    settle('parts = [2]\n[points]\n"9" = 15')
    lines = _listed(kit)
    assert "Part 1 | 100 | `parts = [1, 2]` in course.toml takes it in" in lines
    assert "Part 2 | 0 | and up to 25 more as a bonus" in lines
    assert "→ | 08 | Refraction (bonus) | 10 | not started" in lines


def test_a_kit_of_one_part_is_listed_without_a_word_of_parts(project: Project, kit: Project) -> None:
    for name in _SECOND:
        shutil.copy(project.steps / name / "step.toml", kit.steps / name)
    assert not [line for line in _listed(kit) if "Part" in line]


def test_runs_of_steps_are_named_as_they_are_typed(steps: list[Step]) -> None:
    assert steps_words([*steps[:4], *steps[6:]]) == ["1-4", "7-9"]


def test_a_command_line_is_told_of_the_part(
    kit: Project, settle: Callable[[str], Path], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    settle("parts = [1]")
    monkeypatch.setattr(cli, "here", lambda: kit)
    for line in (
        "hint 8",
        "check 8",
        "watch 8",
        "grade . --only 8",
        "render x.nff -o x.png --step 8",
        "inspect x.nff 1 2 --step 8",
    ):
        assert cli.main(line.split()) == UsageError.exit_code
        assert "step 08-refraction belongs to part 2; `parts = [1, 2]` in course.toml" in capsys.readouterr().err


def test_own_pictures_are_drawn_with_the_parts_before(kit: Project, settle: Callable[[str], Path]) -> None:
    """Whether the course has them or not, and never with a part after."""
    settle("parts = [2]")
    assert _numbers([step for step, _ in unfinished(kit, 8)]) == "1234578"
    step = kit_steps(kit)[0]
    shutil.copy(kit.solutions / step.path, kit.steps / step.path)
    assert _numbers([step for step, _ in unfinished(kit, 8)]) == "234578"
    assert last_written(kit) == 1
    settle("parts = [1]")
    _add(kit, "03-phong-shading", "part = 2")
    assert _numbers([step for step, _ in unfinished(kit, 7)]) == "2457"


def test_an_autograder_knows_the_parts(settle: Callable[[str], Path]) -> None:
    """And nothing else of course.toml."""
    for said, packed in (("seed = 5", None), ("parts = [1]\nseed = 5", None), ("seed = 5\nparts = [2, 1]", "[1, 2]")):
        settle(said)
        with zipfile.ZipFile(io.BytesIO(gradescope_zip(here(), []))) as archive:
            texts = [archive.read(name).decode() for name in archive.namelist() if name == "kit/course.toml"]
        assert texts == ([] if packed is None else [f"parts = {packed}\n"])


def test_students_get_the_parts_of_the_course(
    project: Project, monkeypatch: pytest.MonkeyPatch, settle: Callable[[str], Path]
) -> None:
    """What the framework calls of the others are stand-ins that draw nothing. A part needs those before it."""
    second = [replace(step, part=1 + (step.id in _SECOND)) for step in _part_one(project)]
    monkeypatch.setattr(build_release, "read_all_steps", lambda _: second)
    settle("")
    files = written_files(project, second[:7], "Course")
    given = {name.split("/")[1] for name in files if name.startswith("steps/")}
    absent = {name.split("/")[3] for name in files if name.startswith("framework/absent/steps/")}
    assert given == {step.id for step in second[:7]}
    assert absent == {step.id for step in second[7:]}
    with pytest.raises(
        UsageError, match=r"^part 2 goes on from part 1, and a students' kit has no reference .*\[1, 2\]"
    ):
        written_files(project, second[7:], "Course")
    between = [replace(step, part=1 + (step.index == 8)) for step in second]
    monkeypatch.setattr(build_release, "read_all_steps", lambda _: between)
    assert "steps/09-bvh/step.toml" in written_files(project, [*between[:7], between[8]], "Course")
    with pytest.raises(UsageError, match=r"^05-reflection: left out of the course"):
        written_files(project, [*between[:4], *between[5:7]], "Course")
    with pytest.raises(UsageError, match=r"^--steps 8: step 08-refraction belongs to part 2; `parts = \[1, 2\]`"):
        first_steps(["8"], second[:7], others=second[7:])


@pytest.mark.parametrize("course", ["parts = [2]", 'steps = "1-5"'])
def test_a_course_without_trees_ranks_nobody(
    kit: Project,
    settle: Callable[[str], Path],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    course: str,
) -> None:
    _add(kit, "09-bvh", "left_out = true")
    settle(course)
    monkeypatch.setattr(cli, "here", lambda: kit)
    assert cli.main(["leaderboard", str(kit.root)]) == UsageError.exit_code
    assert "no step of this course has a tree whose work is counted" in capsys.readouterr().err


def test_pictures_are_drawn_with_no_part_after_their_own(project: Project) -> None:
    """An own step 20 of part one goes on from step 09, though part two's numbers lie between."""
    every = read_all_steps(project)
    own = replace(every[0], id="20-fog", part=1)
    tenth = next(step for step in every if step.id == "10-sampling")
    assert _numbers(earlier(own, [*every, own])) == "123456789"
    assert _numbers(earlier(tenth, [*every, own])) == "123456789"
    assert _numbers(earlier(every[3], every)) == "123"


@pytest.mark.parametrize("word", ["0", "16", "19", "x"])
def test_a_picture_is_of_a_step_that_there_is(project: Project, settle: Callable[[str], Path], word: str) -> None:
    settle("parts = [1, 2]")
    with pytest.raises(UsageError, match="--step: expected the number of a step"):
        wanted_step(project, ["--step", word])
    assert wanted_step(project, ["--step", "10"]) == 10


def test_a_picture_of_part_two_needs_no_tree_either(kit: Project) -> None:
    """The stubs of this kit build none."""
    assert without_tree(kit, 8, []) == ["--accel", "none"]
    assert without_tree(kit, 10, []) == ["--accel", "none"]
    assert without_tree(kit, 9, []) == []


def test_an_own_step_goes_out_without_the_part_between(project: Project) -> None:
    every = read_all_steps(project)
    own = replace(every[0], id="20-fog", part=1)
    assert _numbers(first_steps(["1-9", "20"], [*every, own])) == "12345678920"
    assert [step.number for step in first_steps(["10"], every)] == [f"{number:02}" for number in range(1, 11)]
