"""What is said when something does not build."""

from pathlib import Path

import pytest

from raysteps.common.process import Outcome
from raysteps.kit.building import BuildTree, first_error, is_fault_of_step
from raysteps.kit.project import Project

MINE = Path("/w/build/grade-submission")


def test_the_students_own_file_comes_first() -> None:
    output = (
        "/w/framework/core/ray.hpp:3:1: error: in a header\n"
        "/w/build/grade-submission/04-shadows/shadows.cpp:12:5: error: 'nope' was not declared in this scope\n"
    )
    assert first_error(output, MINE) == "shadows.cpp:12:5: 'nope' was not declared in this scope"


def test_linker_errors() -> None:
    output = "/usr/bin/ld: tracer.cpp:(.text+0x1): undefined reference to `raysteps::shadow_ray(int)'\n"
    assert first_error(output, MINE) == "undefined reference to `raysteps::shadow_ray(int)'"


def test_nothing_to_say() -> None:
    assert first_error("ninja: build stopped", MINE) == ""


def test_no_escape_codes_reach_the_terminal() -> None:
    output = "/w/build/grade-submission/04-shadows/shadows.cpp:1:2: error: \x1b[31mred\x1b[0m\x07"
    assert first_error(output, MINE) == "shadows.cpp:1:2: red"


OWN = "/w/build/grade-submission/04-shadows/shadows.cpp"


@pytest.mark.parametrize(
    ("output", "expected"),
    [
        (f"{OWN}:12:5: error: 'nope' was not declared in this scope", True),
        (f"{OWN}:3:10: fatal error: nothing.hpp: No such file or directory", True),
        (f"In file included from {OWN}:1:\n/usr/include/c++/12/vector:3:1: error: static assertion failed", True),
        ("FAILED: bin/test-isolated-04\nld: tracer.cpp: undefined reference to `raysteps::shadow_ray()'", True),
        ("FAILED: bin/test-framework\nld: a.cpp: undefined reference to `b'", False),
        ("/w/framework/core/ray.hpp:3:1: error: in a header", False),
        (f"{OWN}:12:5: fatal error: error writing to /tmp/a.s: No space left on device", False),
        ("c++: fatal error: Killed signal terminated program cc1plus", False),
        ("CMake Error: cannot configure", False),
    ],
)
def test_whose_fault_a_failed_build_is(output: str, expected: bool) -> None:
    outcome = Outcome(code=1, timed_out=False, stdout=output, stderr="", seconds=1.0)
    assert is_fault_of_step(outcome, Path(OWN), ["test-isolated-04", "raytrace-isolated-04"]) is expected


def test_a_build_folder_of_another_clone_is_configured_anew(tmp_path: Path) -> None:
    project = Project(tmp_path / "clone")
    tree = BuildTree(project, "release", tmp_path / "clone" / "build", project.steps)
    (tree.folder / "CMakeFiles").mkdir(parents=True)
    cache = tree.folder / "CMakeCache.txt"
    (tree.folder / "build.ninja").touch()
    lines = f"RAYSTEPS_MINE_DIR:PATH={tree.mine}\nCMAKE_HOME_DIRECTORY:INTERNAL="
    cache.write_text(f"{lines}{project.root}\n")
    tree.forget_other_home()
    assert tree.is_configured()
    cache.write_text(f"{lines}/elsewhere\n")
    assert not tree.is_configured()
    tree.forget_other_home()
    assert not cache.exists()
    assert not (tree.folder / "CMakeFiles").exists()
