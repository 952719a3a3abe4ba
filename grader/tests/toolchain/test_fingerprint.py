"""One state of the kit and another."""

import subprocess
import sys
from pathlib import Path

import pytest

from raysteps.course.project import Project
from raysteps.toolchain.fingerprint import GRADING, fingerprint

pytestmark = pytest.mark.portable

FILES = {
    "CMakeLists.txt": "project(x)",
    "CMakePresets.json": "{}",
    "framework/core/ray.hpp": "struct Ray {};",
    "steps/01-camera-rays/step.toml": "id = 1",
    "steps/01-camera-rays/camera_rays.hpp": "// contract",
    "steps/01-camera-rays/camera_rays_test.cpp": "// tests",
    "solutions/01-camera-rays/camera_rays.cpp": "// answer",
    "solutions/01-camera-rays/cases.toml": "x = 1",
    "scenes/lessons/a.nff": "b 0 0 0",
    "scenes/lessons/b.pbrt": "WorldBegin",
    "grader/src/raysteps/judge/worker.py": "pass",
    "grader/src/raysteps/results/model.py": "pass",
}


@pytest.fixture
def copy(tmp_path: Path) -> Project:
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return Project(tmp_path)


@pytest.mark.parametrize("name", FILES)
def test_what_a_grade_depends_on_counts(copy: Project, name: str) -> None:
    before = fingerprint(copy)
    assert fingerprint(copy) == before
    (copy.root / name).write_text("another")
    assert fingerprint(copy) != before


@pytest.mark.parametrize(
    "name",
    [
        "steps/01-camera-rays/camera_rays.cpp",  # a student's own
        "steps/01-camera-rays/.camera_rays.hpp.swp",
        "steps/01-camera-rays/camera_rays.hpp~",
        "steps/01-camera-rays/README.md",
        "grader/src/raysteps/report/page.py",
        "grader/src/raysteps/report/student.py",
        "scenes/mine.ppm",
        "grader/src/raysteps/cli/render.py",
        "grader/src/raysteps/desk/desk.py",
        "tools/bench/charts.py",
        "scenes/.DS_Store",
        "grader/src/raysteps/cli/__pycache__/app.cpython-311.pyc",
    ],
)
def test_what_lies_beside_it_does_not(copy: Project, name: str) -> None:
    before = fingerprint(copy)
    (copy.root / name).parent.mkdir(parents=True, exist_ok=True)
    (copy.root / name).write_text("x")
    assert fingerprint(copy) == before


def test_every_package_that_grading_loads_counts() -> None:
    """In a process of its own: this one has loaded many others."""
    modules = ("classroom.worker", "grading.pipeline", "submission.load", "sandbox.detect")
    asked = "; ".join(f"import raysteps.{module}" for module in modules)
    told = "print(*{name.split('.')[1] for name in sys.modules if name.startswith('raysteps.')})"
    command = [sys.executable, "-P", "-c", f"import sys; {asked}; {told}"]
    loaded = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    assert set(loaded) == set(GRADING)
