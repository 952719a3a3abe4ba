"""What `render`, `inspect` and `view` say when a student's steps do not build."""

from pathlib import Path

import pytest
from course_fakes import small_project, write_own

from raysteps.cli.render import why_own_steps_do_not_build
from raysteps.common.process import Outcome
from raysteps.course.manifest import Step
from raysteps.course.project import Project

_OWN = "../../steps/03-phong-shading/phong_shading.cpp"
_NINJA = f"""[1/7] Building CXX object framework/CMakeFiles/kit.dir/core/box.cpp.o
[2/7] Building CXX object CMakeFiles/mine-03.dir/steps/03-phong-shading/phong_shading.cpp.o
FAILED: CMakeFiles/mine-03.dir/steps/03-phong-shading/phong_shading.cpp.o
/usr/bin/ccache /usr/bin/c++ -DRAYSTEPS -I/kit -O2 -o phong_shading.cpp.o -c {_OWN}
"""
_STOPPED = "ninja: build stopped: subcommand failed.\n"


@pytest.fixture
def course(tmp_path: Path, steps: list[Step]) -> Project:
    project = small_project(tmp_path)
    write_own(project, steps[2], "int one;\nint two = nope;\nint three;\n")
    return project


def _told(course: Project, stdout: str, stderr: str = "") -> str:
    return why_own_steps_do_not_build(course, Outcome(1, timed_out=False, stdout=stdout, stderr=stderr, seconds=3.0))


@pytest.mark.parametrize("on_stderr", [True, False])
def test_the_students_error_comes_first_and_nothing_of_the_build(course: Project, on_stderr: bool) -> None:
    errors = f"../core/ray.hpp:3:1: error: in a header\n{_OWN}:2:11: error: 'nope' was not declared\n"
    said = (_NINJA + _STOPPED, errors) if on_stderr else (_NINJA + errors + _STOPPED, "")
    assert _told(course, *said) == (
        "step 03 does not build: phong_shading.cpp:2:11: 'nope' was not declared\n"
        "    1 | int one;\n    2 | int two = nope;\n      |           ^\n    3 | int three;"
    )


def test_an_error_in_a_header_is_of_the_step_that_was_built(course: Project) -> None:
    told = _told(course, f"{_NINJA}/usr/include/glm/vec3.hpp:7:2: error: no match for operator+\n{_STOPPED}")
    assert told == "step 03 does not build: vec3.hpp:7:2: no match for operator+"


def test_a_function_that_is_gone_is_named(course: Project) -> None:
    said = "FAILED: bin/raytrace-mine\nld: trace.cpp: undefined reference to `raysteps::shade(int)'\n"
    assert _told(course, said).startswith("step 03 does not build: shade(int) is missing. The file must define it")


def test_a_helper_that_is_defined_nowhere_is_of_the_step_that_calls_it(course: Project) -> None:
    called = "ld: /kit/steps/03-phong-shading/phong_shading.cpp:12: undefined reference to `raysteps::helper(int)'\n"
    assert _told(course, f"FAILED: bin/raytrace-mine\n{called}").startswith(
        "step 03 does not build: raysteps::helper(int) is called, but defined nowhere."
    )


def test_a_file_of_the_kit_that_fails_is_not_the_students_fault(course: Project) -> None:
    kits = "FAILED: framework/CMakeFiles/kit.dir/core/box.cpp.o\n../core/box.cpp:7:2: error: kit broken\n"
    told = _told(course, f"{_NINJA}{kits}{_STOPPED}")
    assert told.startswith("your steps do not build:\n[1/7]")
    assert "box.cpp:7:2: error: kit broken" in told


def test_a_build_that_was_stopped_is_told(course: Project) -> None:
    outcome = Outcome(-9, timed_out=True, stdout="[1/9] Building", stderr="", seconds=1800.0)
    assert why_own_steps_do_not_build(course, outcome) == "your steps do not build: it was stopped after 1800 s"


def test_what_is_not_understood_is_shown_from_its_failure_on(course: Project) -> None:
    told = _told(course, f"[1/7] Building CXX object x.o\nFAILED: x.o\nc++: fatal error: Killed\n{_STOPPED}")
    assert told.startswith("your steps do not build:\nFAILED: x.o\n")
