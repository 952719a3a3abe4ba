"""What is said when a step does not build."""

import pytest

from raysteps.common.process import Outcome
from raysteps.course.manifest import Step
from raysteps.grading.build_messages import compile_message, forbidden_message, link_message
from raysteps.sandbox.task import LimitHit, TaskResult

SOURCE = "#include <a>\n\nint one;\nint two = nope;\nint three;\n"


def ran(stderr: str, *, stopped: LimitHit = "", seconds: float = 1.0) -> TaskResult:
    return TaskResult(Outcome(1, stopped == "wall", "", stderr, seconds), {}, seconds, stopped)


@pytest.fixture
def shadows(steps: list[Step]) -> Step:
    return steps[3]


def test_the_students_own_file_comes_first_with_the_lines_around_it(shadows: Step) -> None:
    output = "/in/0/kit/core/ray.hpp:3:1: error: in a header\n/in/1/shadows.cpp:4:11: error: 'nope' was not declared\n"
    assert compile_message(shadows, SOURCE, ran(output)) == (
        "It does not build: shadows.cpp:4:11: 'nope' was not declared\n"
        "    3 | int one;\n    4 | int two = nope;\n      |           ^\n    5 | int three;"
    )


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (["4: nope"], ""),
        (["4: nope", "4: nope"], ""),
        (["4: nope", "4: what"], "    4 | what"),
        (["4: nope", "5: x", "4: nope", "3: y"], "    5 | x\n    3 | y"),
        ([f"{line}: x" for line in range(1, 9)], "    2 | x\n    3 | x\n    4 | x\n      | and 4 more"),
    ],
)
def test_more_errors_are_told_in_a_line_each(shadows: Step, said: list[str], told: str) -> None:
    output = "".join(
        f"/in/1/shadows.cpp:{one.replace(': ', ':1: error: ')}\n/in/0/b.hpp:7:1: error: z\n" for one in said
    )
    shown, _, rest = compile_message(shadows, SOURCE, ran(output)).partition("\nMore errors, ")
    assert shown.startswith(f"It does not build: shadows.cpp:{said[0].replace(': ', ':1: ')}\n")
    assert rest.partition("\n")[2] == told


@pytest.mark.parametrize(
    ("output", "place"),
    [
        ("C:\\kit\\core\\ray.hpp:3:1: error: x\nC:\\Users\\Jo B\\shadows.cpp:4:11: error: nope\n", "4:11: nope"),
        ("shadows.cpp\nC:\\Jo B\\shadows.cpp(4): error C2065: 'nope': undeclared\n", "4: C2065: 'nope': undeclared"),
    ],
)
def test_places_as_windows_writes_them(shadows: Step, output: str, place: str) -> None:
    message = compile_message(shadows, SOURCE, ran(output))
    assert message.startswith(f"It does not build: shadows.cpp:{place}\n    3 | int one;\n    4 | int two = nope;\n")


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        (ran("/in/0/kit/core/ray.hpp:3:1: error: in a header"), "It does not build: ray.hpp:3:1: in a header"),
        (ran("c++: fatal error: Killed"), "It does not build: c++: fatal error: Killed"),
        (ran(""), "It does not build: the compiler gave up and said nothing."),
        (ran("", stopped="memory"), "It does not build: the compiler needed more memory than it may have."),
    ],
)
def test_other_ends_of_a_compiler(shadows: Step, said: TaskResult, expected: str) -> None:
    assert compile_message(shadows, SOURCE, said) == expected


def test_a_compiler_that_was_stopped(shadows: Step) -> None:
    message = compile_message(shadows, SOURCE, ran("", stopped="wall", seconds=60.2))
    assert message.startswith("It does not build: the compiler was stopped after 60 s")


def test_no_escape_codes_reach_the_terminal(shadows: Step) -> None:
    output = "/in/1/shadows.cpp:1:2: error: \x1b[31mred\x1b[0m\x07"
    assert compile_message(shadows, "\x1b[2Jfirst", ran(output)).splitlines()[:2] == [
        "It does not build: shadows.cpp:1:2: red",
        "    1 | first",
    ]


def test_a_place_beyond_the_source_is_no_trouble(shadows: Step) -> None:
    message = compile_message(shadows, "", ran("/in/1/shadows.cpp:9:9: error: unterminated #if"))
    assert message.startswith("It does not build: shadows.cpp:9:9: unterminated #if")


def test_a_missing_function_is_named() -> None:
    output = "/usr/bin/ld: tracer.cpp:(.text+0x1): undefined reference to `raysteps::shadow_ray(int)'\n"
    assert link_message(ran(output)).startswith("It does not build: raysteps::shadow_ray(int) is missing.")


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (
            'x.obj : error LNK2019: unresolved external symbol "bool __cdecl raysteps::f(int)" (?f) referenced',
            "missing",
        ),
        ('y.obj : error LNK2005: "int __cdecl raysteps::f(int)" (?f@@YA) already defined in x.obj', "defined twice"),
    ],
)
def test_microsofts_linker_is_understood(said: str, told: str) -> None:
    message = link_message(TaskResult(Outcome(1, False, said, "", 1.0), {}, 1.0, ""))
    assert "raysteps::f(int) is " + told in message


def test_a_step_that_reaches_for_what_is_not_its_own() -> None:
    later = {"_ZN8raysteps12build_octreeE": "06-octree"}
    assert "a function of step 06-octree" in forbidden_message(tuple(later), later)
    assert "counters" in forbidden_message(("_ZN8raysteps7t_statsE",), later)
