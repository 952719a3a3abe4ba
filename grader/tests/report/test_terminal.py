"""What is printed in a terminal: lines that do not fit stand below the text's beginning."""

import io
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from raysteps.course.manifest import Step
from raysteps.course.project import here
from raysteps.images.compare import write_png
from raysteps.report.terminal import print_details, print_diagnoses, print_table
from raysteps.report.wording import warnings_of
from raysteps.results.model import Diagnosis, HiddenResult, ImageResult, Results, StepResult, TestResult

_LONG = "a sentence that is far too long for a narrow terminal [and in brackets] and goes on and on"


def _printed(steps: list[Step], *, width: int, terminal: bool) -> list[str]:
    result = StepResult(steps[1].id, "partial", 1.0, steps[1].points, steps[1].bonus)
    result.messages = [f"{_LONG}\n  7 | return {{}};"]
    result.tests = [TestResult(_LONG, False, _LONG, _LONG, "2 == 1", "a.cpp:7")]
    result.hidden = [HiddenResult("closest_hit", "function", 0.5, message=_LONG, given=_LONG, case="cases/a.json")]
    result.diagnoses = [Diagnosis("mistake", "one", _LONG, _LONG, _LONG, alike=[_LONG])]
    result.cumulative.message = _LONG
    console = Console(file=io.StringIO(), width=width, force_terminal=terminal, color_system=None)
    print_details(console, Results.of("ann", [result]), steps, here().build, lambda case: f"replay {case}")
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue().splitlines()


def test_a_line_that_does_not_fit_keeps_its_indent(steps: list[Step]) -> None:
    lines = _printed(steps, width=60, terminal=True)
    assert max(map(len, lines)) <= 60
    inner = [line for line in lines[2:] if line]
    assert all(line.startswith("  ") for line in inner)
    at = next(at for at, line in enumerate(lines) if line.startswith("             expected  "))
    assert lines[at + 1].startswith(" " * 23)
    assert lines[at + 1][23] != " "
    assert "  7 | return {};" in "\n".join(lines)
    said = " ".join(" ".join(lines).split())
    assert said.count(_LONG) == 11


def test_what_could_not_be_read_is_not_called_not_started(steps: list[Step]) -> None:
    why = "intersection.cpp is a folder, not a file, and was not taken."
    results = [StepResult(step.id, "not-started", 0.0, step.points, step.bonus) for step in steps[:2]]
    results[1].not_taken, results[1].messages = why, [why]
    console = Console(file=(text := io.StringIO()), width=10_000, color_system=None)
    print_table(console, Results.of("ann", results))
    first, second = (line for line in text.getvalue().splitlines() if "│" in line)
    assert ("not started" in first, "not taken" in first) == (True, False)
    assert ("not started" in second, "not taken" in second) == (False, True)


def test_a_wrong_picture_of_ones_own_has_the_command_of_its_worst_pixel(steps: list[Step], tmp_path: Path) -> None:
    result = StepResult(steps[1].id, "partial", 1.0, steps[1].points, steps[1].bonus)
    reference = np.full((120, 160, 3), 100, dtype=np.uint8)
    mine = reference.copy()
    mine[7, 31] = (100, 180, 100)
    for name, pixels in (("mine.png", mine), ("reference.png", reference)):
        write_png(pixels, tmp_path / name)
    case = steps[1].images[0]
    result.images = [ImageResult(case.name, case.scene, False, 0.1, mine="mine.png", reference="reference.png")]
    said = {}
    for own in (False, True):
        console = Console(file=(text := io.StringIO()), width=10_000, color_system=None)
        print_details(console, Results.of("ann", [result]), steps, tmp_path, str, own=own)
        said[own] = text.getvalue()
    size = case.args[case.args.index("--size") + 1]
    line = next(line for line in said[True].splitlines() if line.startswith(" " * 13 + "worst     ./raysteps inspect "))
    assert f"inspect {case.scene} 31 7 " in line
    assert f" --size {size} " in line
    assert line.endswith(" --against reference")
    assert "raysteps inspect" not in said[False]


def test_elsewhere_no_line_is_broken(steps: list[Step]) -> None:
    lines = _printed(steps, width=10_000, terminal=False)
    assert sum(_LONG in line for line in lines) == 11
    assert all(line == line.rstrip() for line in lines)


def test_what_explains_a_step_of_ones_own_is_left_for_the_end(steps: list[Step], tmp_path: Path) -> None:
    """There a person looks first, and there it comes also where it had to be learned before."""
    result = StepResult(steps[1].id, "partial", 1.0, steps[1].points, steps[1].bonus)
    result.diagnoses = [Diagnosis("mistake", "one", "the normal is not of unit length")]
    results = Results.of("ann", [result])
    console = Console(file=(text := io.StringIO()), width=100, color_system=None)
    print_details(console, results, steps, tmp_path, str, own=True)
    assert "unit length" not in text.getvalue()
    print_diagnoses(console, results, steps)
    assert "most likely  the normal is not of unit length" in text.getvalue()


def test_places_in_ones_own_files_are_told_with_their_folder(steps: list[Step], tmp_path: Path) -> None:
    """An editor opens a place that it finds from the folder of the kit."""
    result = StepResult(steps[0].id, "failed", 1.0, steps[0].points, steps[0].bonus)
    result.messages = ["It does not build: camera_rays.cpp:14:49: no\n   14 | // camera_rays.cpp:3\n      | ^"]
    result.build_log = "camera_rays.cpp:5:1: warning: unused [-Wx]\n/in/1/camera_rays.cpp:6:1: warning: too [-Wx]"
    result.tests = [TestResult("a", False, "crashed at camera_rays.cpp:9", location="camera_rays_test.cpp:7")]
    result.diagnoses = [Diagnosis("finding", "one", "`v` (camera_rays.cpp:8) has no value.")]
    folder, said = f"steps/{steps[0].id}/", {}
    for own in (False, True):
        console = Console(file=(text := io.StringIO()), width=300, color_system=None)
        print_details(console, Results.of("ann", [result]), steps, tmp_path, str, own=own)
        if own:
            print_diagnoses(console, Results.of("ann", [result]), steps)
        said[own] = text.getvalue()
    for place in ("camera_rays.cpp:14:49: no", "camera_rays.cpp:5:1: unused", "camera_rays.cpp:9", "camera_rays.cpp:8"):
        assert f" {folder}{place}" in said[True].replace("(", " ")
    assert f"   {folder}camera_rays_test.cpp:7\n" in said[True]
    assert "14 | // camera_rays.cpp:3" in said[True]
    assert "/in/1/camera_rays.cpp:6:1: too" in said[True]
    assert folder not in said[False], "an instructor's kit is not where the submission lies"


def test_a_newcomer_is_told_what_together_means(steps: list[Step]) -> None:
    result = StepResult(steps[1].id, "passed", 1.0, steps[1].points, steps[1].bonus, tests=[TestResult("a", True)])
    result.cumulative.passed = True
    console = Console(file=(text := io.StringIO()), width=300, color_system=None)
    print_table(console, Results.of("ann", [result]))
    assert "│ right " in text.getvalue()
    assert "is the step's first picture also right with your own earlier steps?" in text.getvalue()


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (
            "own.cpp:66:11: warning: 'nearer' is used uninitialized [-Wuninitialized]",
            "'nearer' is used uninitialized\n",
        ),
        ("C:\\kit\\own.cpp:66:11: warning: unused", "C:\\kit\\own.cpp:66:11: unused\n"),
        ("own.cpp(66,11): warning C4700: no value", "own.cpp(66,11): warning C4700: no value\n"),
        ("own.cpp:6:1: warning: conversion from 'int' to 'float' may", "float(a) / float(b)."),
        ("own.cpp:6:1: warning: implicit conversion from 'int' to 'float' may", "float(a) / float(b)."),
        ("own.cpp(6,1): warning C4244: 'return': conversion from 'int' to 'float', possible", "float(a) / float(b)."),
        (f"own.cpp:6:1: warning: {'long ' * 99}", "own.cpp:6:1: long long"),
    ],
)
def test_warnings_of_every_compiler_are_found(steps: list[Step], tmp_path: Path, line: str, said: str) -> None:
    result = StepResult(steps[1].id, "failed", 0.0, steps[1].points, steps[1].bonus, build_log=f"{line}\n  x\n")
    console = Console(file=(text := io.StringIO()), width=200, color_system=None)
    print_details(console, Results.of("ann", [result]), steps, tmp_path, str, own=True)
    assert said in text.getvalue()


def test_the_warning_that_matters_most_comes_first(steps: list[Step]) -> None:
    """Numbers that are converted are many in a right solution, too."""
    converted = [f"own.cpp:{line}:1: warning: conversion from 'int' to 'float' may change value" for line in range(5)]
    more = ["own.cpp:8:1: warning: unused variable 'k'", "own.cpp:9:1: warning: 'k' is used uninitialized"]
    result = StepResult(steps[1].id, "failed", 0.0, steps[1].points, steps[1].bonus)
    result.build_log = "\n".join([*converted, *more])
    (first, *_), (second, *_), (third, advice) = warnings_of(result)
    assert first.endswith("'k' is used uninitialized")
    assert second.endswith("unused variable 'k'")
    assert third.startswith("own.cpp:0:1: conversion from 'int' to 'float'")
    assert "float(a) / float(b)" in advice
    result.build_log = "\n".join(converted)
    assert [len(lines) for lines in warnings_of(result)] == [2, 1, 1], "what to do is said once"


def test_warnings_of_the_compiler_stand_above_what_went_wrong(steps: list[Step], tmp_path: Path) -> None:
    result = StepResult(steps[1].id, "failed", 0.0, steps[1].points, steps[1].bonus, tests=[TestResult("a", False)])
    said = "own.cpp:66:11: warning: 'nearer' is used uninitialized"
    result.build_log = f"own.cpp: In function 'f':\n{said} [-Wuninitialized]\n 66 | x\n"
    printed = {}
    for status in ("failed", "passed"):
        result.status = "passed" if status == "passed" else "failed"
        console = Console(file=(text := io.StringIO()), width=200, color_system=None)
        print_details(console, Results.of("ann", [result]), steps, tmp_path, str, own=True)
        printed[status] = text.getvalue()
    assert f"  warning  {said.replace('warning: ', '')}\n" in printed["failed"]
    assert "is used uninitialized" not in printed["passed"]
