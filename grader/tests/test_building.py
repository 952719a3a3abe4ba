"""What is said when something does not build."""

from pathlib import Path

from raysteps.building import first_error

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
