"""At home a student's steps stand on the student's own earlier ones: what they may bring along costs nothing."""

import json
import sys
from pathlib import Path

import pytest

from raysteps.common.process import run
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import stub_for

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("students_kit")]


def _checked(root: Path, number: str) -> dict[str, object]:
    start = f"import sys; sys.path[0] = {str(root / 'grader' / 'src')!r}; sys.argv = ['raysteps', 'check', {number!r}]"
    program = f"{start}; import runpy; runpy.run_module('raysteps', run_name='__main__', alter_sys=False)"
    said = run([sys.executable, "-c", program], seconds=900, cwd=root)
    assert said.code in (0, 1), said.stderr
    found = json.loads((root / "build/check/results.json").read_text(encoding="utf-8"))["steps"]
    step = next(one for one in found if one["id"].startswith(number))
    assert isinstance(step, dict)
    return step


def test_rounding_of_an_earlier_step_and_a_tree_that_is_not_written(
    project: Project, students_kit: Path, steps: list[Step], solved: dict[str, str]
) -> None:
    """The sphere as most books have it gives other pixels where mirrors magnify its rounding."""
    root = students_kit
    textbook = project.solutions / steps[1].id / "alternatives" / "textbook-quadratic.cpp"
    for step in steps[:7]:
        (root / "steps" / step.path).write_text(solved[step.id], encoding="utf-8")
    (root / "steps" / steps[1].path).write_text(textbook.read_text(encoding="utf-8"), encoding="utf-8")

    octree = _checked(root, "06")
    assert (octree["status"], octree["points"]) == ("passed", octree["max"]), octree
    images = octree["images"]
    assert isinstance(images, list)
    assert "The same as without a tree" in " ".join(image["message"] for image in images)

    wrong = solved[steps[5].id].replace("hit->distance < distance", "hit->distance > distance")
    assert wrong != solved[steps[5].id]
    (root / "steps" / steps[5].path).write_text(wrong, encoding="utf-8")
    assert _checked(root, "06")["status"] == "partial", "shadows that are wrong with a tree only"

    (root / "steps" / steps[5].path).write_text(stub_for(project, steps[5]), encoding="utf-8")
    toned = _checked(root, "07")
    assert (toned["status"], toned["points"]) == ("passed", toned["max"]), toned
