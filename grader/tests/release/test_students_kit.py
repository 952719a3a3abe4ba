"""What students get works by itself, in a folder of its own."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from raysteps.common.errors import UsageError
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import Step
from raysteps.release.build_release import first_steps, refuse_foreign_files, release, write_release
from raysteps.toolchain.kit_artifacts import BuiltKit

_LINK = re.compile(r"\]\(([^)#\s]+)[^)\s]*\)")


@pytest.fixture(scope="module")
def released(kit: BuiltKit, steps: list[Step], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("course") / "kit"
    write_release(kit, first_steps(["1-4"], steps), "Graphics 101", folder)
    return folder


def _raysteps(root: Path, *words: str) -> Outcome:
    """With the modules of the kit in that folder and no others."""
    start = f"import sys; sys.path[0] = {str(root / 'grader' / 'src')!r}; sys.argv = ['raysteps', *{list(words)!r}]"
    program = f"{start}; import runpy; runpy.run_module('raysteps', run_name='__main__', alter_sys=False)"
    return run([sys.executable, "-c", program], seconds=900, cwd=root)


def _solve(root: Path, steps: list[Step], solved: dict[str, str]) -> None:
    for step in steps[:4]:
        (root / "steps" / step.path).write_text(solved[step.id], encoding="utf-8")


def test_only_the_chosen_steps_are_there(released: Path) -> None:
    assert len(list(released.glob("steps/*/step.toml"))) == 4
    assert sorted(path.name for path in (released / "framework/absent/steps").iterdir())[0] == "05-reflection"
    assert not (released / "solutions").exists()
    assert not list(released.rglob("mutants*"))
    assert not list((released / "framework").rglob("*_test.cpp"))
    assert "Graphics 101" in (released / "README.md").read_text(encoding="utf-8")
    assert os.access(released / "raysteps", os.X_OK)


def test_no_module_is_missing_and_none_knows_answers(released: Path) -> None:
    source = released / "grader" / "src"
    names = [".".join(path.relative_to(source).with_suffix("").parts) for path in sorted(source.rglob("*.py"))]
    names = [name.removesuffix(".__init__") for name in names if not name.endswith(("__main__", "keeper"))]
    assert "raysteps.grading.self_check" in names
    knowing = {"judge", "mutants", "diagnosis", "blame", "divergence", "pipeline", "grade", "tools"}
    assert not [name for name in names if knowing.intersection(name.split("."))]
    code = f"import sys, importlib; sys.path[0] = {str(source)!r}\nfor name in {names!r}: importlib.import_module(name)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=released)
    assert done.returncode == 0, done.stderr


def test_no_link_leads_nowhere(released: Path) -> None:
    pages = list(released.rglob("*.md"))
    assert len(pages) > 4
    for page in pages:
        for link in _LINK.findall(page.read_text(encoding="utf-8")):
            assert ":" in link or (page.parent / link).exists(), f"{page}: {link}"


def test_the_steps_of_a_release_begin_at_the_first(steps: list[Step]) -> None:
    for text in ("1-3", "1,2,3", "01 02 03", "3"):
        assert [step.number for step in first_steps([text], steps)] == ["01", "02", "03"]
    assert first_steps([], steps) == steps
    for text in ("2-4", "1,3", "", "2-3,7"):
        with pytest.raises(UsageError, match=f"--steps {text}: .*such as 1-4"):
            first_steps([text], steps)
    for text, words in (("1-12", "no step '12'"), ("0", "no step '0'"), ("x", "no step 'x'"), ("3-1", "expected 1-3")):
        with pytest.raises(UsageError, match=rf"^--steps {text}: .*{words}"):
            first_steps([text], steps)
    with pytest.raises(UsageError, match=r"^course\.toml:1:1: expected the first and the last"):
        first_steps(["3"], steps, "course.toml:1:1")


def test_the_steps_of_a_course_that_begins_later(steps: list[Step]) -> None:
    later = [steps[1], steps[2], *steps[4:]]
    assert [step.number for step in first_steps(["3"], later)] == ["02", "03"]
    assert [step.number for step in first_steps(["2-5"], later)] == ["02", "03", "05"]
    with pytest.raises(UsageError, match=r"--steps 2-4: there is no step '4'.* The steps are 02-"):
        first_steps(["2-4"], later)


def test_a_step_that_is_left_out_in_between_is_refused(kit: BuiltKit, steps: list[Step], tmp_path: Path) -> None:
    """The pictures after it would be those of the reference, which has it."""
    left = [step for step in steps if step.number not in ("05", "09")]
    with pytest.raises(UsageError, match=r"^05-reflection: left out .* end before it with `--steps 1-4`, or let it in"):
        write_release(kit, left, "Course", tmp_path / "kit")
    with pytest.raises(UsageError, match=r"^01-camera-rays: left out .* no reference to stand in; let it in"):
        write_release(kit, steps[1:], "Course", tmp_path / "kit")
    assert not (tmp_path / "kit").exists()


def test_nothing_but_a_release_is_replaced(released: Path, tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(UsageError, match="is not empty"):
        refuse_foreign_files(tmp_path)
    refuse_foreign_files(released)
    (released / "syllabus.md").write_text("mine")
    with pytest.raises(UsageError, match=r"syllabus\.md: is not of the release"):
        refuse_foreign_files(released)
    (released / "syllabus.md").unlink()


def test_what_leaks_is_not_written(kit: BuiltKit, steps: list[Step], tmp_path: Path) -> None:
    assert not release(kit, steps[:1], "Course", tmp_path / "kit", lambda new, out: True, lambda text: None)
    assert not list(tmp_path.iterdir())


def _results(root: Path) -> dict[str, Any]:
    document = json.loads((root / "build/check/results.json").read_text(encoding="utf-8"))
    return {step["id"]: step for step in document["steps"]}


@pytest.mark.slow
def test_it_builds_and_checks_itself(released: Path, steps: list[Step], solved: dict[str, str]) -> None:
    """One build. A broken step 02 shows in step 03, and is named there."""
    _solve(released, steps, solved)
    intersection = released / "steps" / steps[1].path
    intersection.write_text(solved[steps[1].id].replace("return closest;", "return std::nullopt;"), encoding="utf-8")

    said = _raysteps(released, "check", "03")
    assert said.code == 1, said.stderr
    assert "Step 02 is not right yet: its mistakes show here too." in said.stdout
    assert "reference/03-phong-shading/balls-lit.png" in said.stdout
    assert "points of the visible part" in said.stdout
    phong = _results(released)["03-phong-shading"]
    assert all(test["passed"] for test in phong["tests"])
    assert not any(image["passed"] for image in phong["images"])
    assert phong["max"] < steps[2].points

    _solve(released, steps, solved)
    assert _raysteps(released, "check").code == 0
    assert {step["status"] for step in _results(released).values()} == {"passed"}

    shadows = released / "steps" / steps[3].path
    shadows.write_text("this is no C++", encoding="utf-8")
    assert _raysteps(released, "check", "04").code == 3
    assert _raysteps(released, "check", "03").code == 0, "a later step that does not build breaks nothing before it"

    reset = _raysteps(released, "reset", "04", "--yes")
    assert reset.code == 0, reset.stderr
    assert shadows.read_bytes() == (released / "grader/stubs" / steps[3].path).read_bytes()
    assert "Hint" in _raysteps(released, "hint", "2").stdout.title()
    assert "students' kit" in _raysteps(released, "render", "x.nff", "-o", "x.png", "--impl", "reference").stderr

    assert _raysteps(released, "render", "--list-accel").stdout.split() == ["none"], "its steps build no tree"
    offered = _raysteps(released, "render", "--help").stdout
    assert "--accel none\n" in offered
    assert not re.search("boxes +what|octree +what|--spd|--impl", offered)
    scene = released / "scenes/lessons/three-spheres.nff"
    boxes = _raysteps(released, "render", str(scene), "-o", "x.png", "--step", "2", "--accel", "boxes")
    assert boxes.code == 2
    assert "only the whole kit has the paper's boxes" in boxes.stderr
    (released / "hollow.nff").write_text(scene.read_text(encoding="utf-8") + "s 0 0 0 -1\n", encoding="utf-8")
    hollow = _raysteps(released, "render", "hollow.nff", "-o", "x.png", "--step", "2")
    assert hollow.code == 2
    assert "only the whole kit has hollow spheres" in hollow.stderr
