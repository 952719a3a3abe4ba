"""What `render`, `inspect` and `view` say when a student's steps do not build."""

import json
import os
import shlex
from pathlib import Path

import pytest
from course_fakes import small_project, write_own, written_course

from raysteps.cli.render import build_mine, why_own_steps_do_not_build
from raysteps.common.errors import StudentBuildError
from raysteps.common.platform import is_windows
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.grading.build_messages import calls_what_it_may_not
from raysteps.toolchain.cmake import BuildTree, release_tree
from raysteps.toolchain.kit_artifacts import BuiltKit

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
        "step 03 does not build: steps/03-phong-shading/phong_shading.cpp:2:11: 'nope' was not declared\n"
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


def test_a_helper_that_is_defined_nowhere_is_shown_where_it_is_called(course: Project, steps: list[Step]) -> None:
    """Also where the linker names no file, and in the words of the header."""
    write_own(
        course, steps[2], "float helper(const HitRecord& hit);\nColor shade() { return helper(hit) * k_white; }\n"
    )
    said = "ld: (.text+0x9): undefined reference to `raysteps::helper(raysteps::HitRecord const&)'\n"
    assert _told(course, f"FAILED: bin/raytrace-mine\n{said}") == (
        "step 03 does not build: steps/03-phong-shading/phong_shading.cpp:2:24: "
        "raysteps::helper(const raysteps::HitRecord&) is called, but defined nowhere. "
        "Is the signature the same in both places?\n"
        "    1 | float helper(const HitRecord& hit);\n"
        "    2 | Color shade() { return helper(hit) * k_white; }\n      |                        ^"
    )


def test_a_step_with_a_helper_of_its_own_of_that_name_is_not_blamed(course: Project, steps: list[Step]) -> None:
    write_own(course, steps[1], "static float helper(float x) {\n    return x;\n}\nfloat y = helper(1);\n")
    write_own(course, steps[2], "float helper(float x);\nfloat y = helper(1);\n")
    said = "FAILED: bin/raytrace-mine\nld: (.text+0x9): undefined reference to `raysteps::helper(float)'\n"
    place = f"{steps[2].id}/phong_shading.cpp:2:11"
    assert _told(course, said).startswith(f"step 03 does not build: steps/{place}: raysteps::helper(float) is")


def test_what_is_there_in_place_of_a_function_that_is_gone_is_asked_about(course: Project, steps: list[Step]) -> None:
    write_own(course, steps[2], "Color Shade(int x) { return k_black; }\n")
    said = "FAILED: bin/raytrace-mine\nld: trace.cpp: undefined reference to `raysteps::shade(int)'\n"
    assert _told(course, said).endswith(
        "The file has Shade: is that meant to be shade? Upper and lower case differ, too."
    )


def test_a_method_that_is_gone_is_of_the_step_whose_it_is(course: Project, steps: list[Step]) -> None:
    write_own(course, steps[1], "int one;\n")
    said = "FAILED: x\nld: a.cpp: undefined reference to `raysteps::Sphere::intersect(raysteps::Ray const&) const'\n"
    assert _told(course, said).startswith("step 02 does not build: Sphere::intersect(const Ray&) const is missing.")


_LATER = '#include "steps/05-reflection/reflection.hpp"\n'


@pytest.mark.parametrize(
    ("step", "source", "said"),
    [
        (4, f"{_LATER}Ray f() {{ return reflected_ray(hit); }}\n", "it calls a function of step 05-reflection, which"),
        (4, f"{_LATER}Ray reflected_ray(int) {{}}\nRay f() {{ return reflected_ray(1); }}\n", ""),
        (4, "Ray reflected_ray(int);\nRay f() { return reflected_ray(hit); }\n", ""),
        (9, "auto f() { return build_octree(scene); }\n", "step 09-bvh may not call build_octree of step 06-octree"),
        (5, '#include "steps/03-phong-shading/phong_shading.hpp"\nauto f() { return mirror(a, b); }\n', ""),
    ],
)
def test_what_a_step_may_not_call_is_refused_where_it_calls_it(
    steps: list[Step], step: int, source: str, said: str
) -> None:
    told = calls_what_it_may_not(steps[step - 1], steps, source)
    assert said in told
    assert bool(said) == bool(told)
    if said:
        assert told.startswith(f"It does not build: {steps[step - 1].file}:{len(source.splitlines())}:")


def test_nothing_is_drawn_with_a_function_that_a_step_may_not_call(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = written_course(tmp_path, 1, 2, 3, 4, 5)
    path = course.steps / "04-shadows" / "shadows.cpp"
    path.write_text(f"{_LATER}Ray f() {{ return reflected_ray(hit); }}\n")
    done = Outcome(0, timed_out=False, stdout="", stderr="", seconds=1)
    monkeypatch.setattr(BuildTree, "build", lambda *_: done)
    place = r"steps/04-shadows/shadows\.cpp:2:18"
    with pytest.raises(StudentBuildError, match=rf"^step 04 does not build: {place}: it calls a function of"):
        build_mine(release_tree(course))


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


@pytest.mark.skipif(is_windows(), reason="Visual C++ has no such option")
def test_a_stub_says_where_it_stands_as_seen_from_the_kit(kit: BuiltKit, tmp_path: Path) -> None:
    """However the build calls the file: what a stub says is compiled in."""
    folder, step = release_tree(kit.project).folder, kit.steps[0]
    own = kit.project.steps / step.path
    commands = json.loads((folder / "compile_commands.json").read_text(encoding="utf-8"))
    (words,) = (shlex.split(one["command"]) for one in commands if (folder / one["file"]).resolve() == own.resolve())
    compiler = words[: words.index("-o")]
    for called in (str(own), os.path.relpath(own, folder)):
        (tmp_path / "stub.cpp").write_text(f'#line 18 "{called}"\n__FILE__\n', encoding="utf-8")
        ran = run([*compiler, "-E", "-P", tmp_path / "stub.cpp"], seconds=60, cwd=folder)
        assert ran.stdout.strip() == f'"steps/{step.path.as_posix()}"', ran.stderr
