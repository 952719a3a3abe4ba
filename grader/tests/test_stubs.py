"""Stubs from solutions, and what counts as not started."""

import dataclasses

import pytest

from raysteps.common.errors import GraderFault
from raysteps.kit.manifest import Step
from raysteps.kit.stubs import make_stub, same_code, unfinished_functions, without_markers

SOLUTION = """#include "a.hpp"

// BEGIN SOLUTION
int helper() { return 1; }
// END SOLUTION

int f() {
    // BEGIN SOLUTION f
    // TODO: Return one.
    // RETURN 0
    return helper();
    // END SOLUTION
}

void g() {
    // BEGIN SOLUTION g
    // TODO: Do it.
    helper();
    // END SOLUTION
}
"""

STUB = """#include "a.hpp"

int f() {
    // TODO: Return one.
    RAYSTEPS_TODO("02-intersection", "f");
    return 0;
}

void g() {
    // TODO: Do it.
    RAYSTEPS_TODO("02-intersection", "g");
}
"""


@pytest.fixture
def step(steps: list[Step]) -> Step:
    return dataclasses.replace(steps[1], functions=("f", "g"))


def test_stub_keeps_what_is_outside_the_regions(step: Step) -> None:
    assert make_stub(SOLUTION, step) == STUB


def test_hand_in_has_no_markers(step: Step) -> None:
    text = without_markers(SOLUTION)
    assert "SOLUTION" not in text
    assert "TODO" not in text
    assert "return helper();" in text


@pytest.mark.parametrize(
    "broken",
    [
        SOLUTION.replace("    // END SOLUTION\n}\n\nvoid", "}\n\nvoid"),
        SOLUTION.replace("// TODO: Do it.", "//"),
        SOLUTION.replace("SOLUTION g", "SOLUTION h"),
        SOLUTION + "// END SOLUTION\n",
    ],
)
def test_broken_markers_are_found(step: Step, broken: str) -> None:
    with pytest.raises(GraderFault):
        make_stub(broken, step)


def test_unfinished_functions(step: Step) -> None:
    assert unfinished_functions(STUB, step) == ["f", "g"]
    assert unfinished_functions(STUB.replace('    RAYSTEPS_TODO("02-intersection", "g");\n', ""), step) == ["f"]
    assert unfinished_functions(STUB.replace("    RAYSTEPS_TODO", "    // RAYSTEPS_TODO"), step) == []
    assert unfinished_functions(STUB.replace("RAYSTEPS_TODO(", "RAYSTEPS_TODO (\n "), step) == ["f", "g"]


def test_white_space_does_not_make_a_start() -> None:
    assert same_code("int a;\n", "int  a ;")
    assert same_code("int a;\n", "// mine\nint a; /* later */")
    assert not same_code("int a;", "int b;")
    assert not same_code('f("// a");', 'f("// b");')
