"""Which kit a course gets: one of its own parts, or the whole one where it is there."""

import json
from pathlib import Path

import pytest
from course_fakes import small_project

from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project
from raysteps.toolchain import build_kit as building
from raysteps.toolchain.build_kit import build_kit, up_to_last
from raysteps.toolchain.fingerprint import fingerprint
from raysteps.toolchain.link import Description


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    """Steps 01 to 08 are part one, 09 is part two. What builds writes down the steps in place of it."""
    project = small_project(tmp_path / "kit")
    for name in ("CMakeLists.txt", "CMakePresets.json"):
        (project.root / name).touch()
    project.solutions.mkdir()  # a students' kit has all that it needs
    (last,) = project.steps.glob("09-*/step.toml")
    last.write_text("part = 2\n" + last.read_text(encoding="utf-8"), encoding="utf-8")

    def build(_project: Project, graded: list[Step], folder: Path, _say: object) -> None:
        folder.mkdir(parents=True)
        (folder / "kit.json").write_text("{}", encoding="utf-8")
        tests: dict[str, dict[str, list[str]]] = {step.id: {} for step in graded}
        facts = {"interpreter": None, "slowness": 1.0, "tests": tests}
        (folder / "facts.json").write_text(json.dumps(facts), encoding="utf-8")

    known = Description.__new__(Description)
    object.__setattr__(known, "compiler_version", "GNU 12")
    monkeypatch.setattr(building, "_build", build)
    monkeypatch.setattr(building, "read_description", lambda _: known)
    return project


def _numbers(steps: list[Step]) -> list[int]:
    return [step.index for step in steps]


def test_a_course_builds_its_own_part_and_takes_the_whole_kit_where_it_is(course: Project) -> None:
    kit = build_kit(course)
    assert kit.folder.name == f"{fingerprint(course)}-1"
    assert _numbers(kit.steps) == list(range(1, 9))
    assert list(kit.tests) == [step.id for step in kit.steps]
    whole = build_kit(course, of_all_parts=True)
    assert whole.folder.name == fingerprint(course)
    assert _numbers(whole.steps) == list(range(1, 10))
    again = build_kit(course)
    assert again.folder == whole.folder
    assert _numbers(again.steps) == list(range(1, 9))
    assert {again.fingerprint, whole.fingerprint} == {kit.fingerprint}  # what was graded stays graded


def test_a_course_of_a_later_part_needs_the_steps_before_it(
    course: Project, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    chosen = tmp_path / "chosen.toml"
    chosen.write_text("parts = [2]\n", encoding="utf-8")
    monkeypatch.setenv("RAYSTEPS_COURSE", str(chosen))
    kit = build_kit(course)
    assert kit.folder.name == f"{fingerprint(course)}-2"
    assert _numbers(kit.steps) == [9]
    assert _numbers(up_to_last(course, kit.steps)) == list(range(1, 10))


def test_a_kit_without_other_parts_is_the_whole_one(course: Project) -> None:
    (last,) = course.steps.glob("09-*/step.toml")
    last.unlink()
    assert build_kit(course).folder.name == fingerprint(course)
    assert len(read_steps(course)) == 8
