"""Stubs from solutions, and what counts as not started."""

import dataclasses
import time

import pytest

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step, kit_steps
from raysteps.course.project import Project
from raysteps.course.stubs import (
    borrowed_functions,
    called_functions,
    make_stub,
    same_code,
    stub_for,
    unfinished_functions,
    uses,
    without_markers,
)

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


def test_unfinished_functions_are_code_and_not_text(step: Step) -> None:
    call = 'RAYSTEPS_TODO("02-intersection", "f");'
    for hidden in (
        f'const char* text = R"({call})";',
        f'const char* text = R"x(" /* )" {call})x";',
        'const char* text = "' + call.replace('"', '\\"') + '";',
        f"/* ' */ // {call}",
        f"// a comment that goes on \\\n{call}",
        f"/\\\n/ {call}",
        f"/\\\n* {call} *\\\n/",
        f"/* never closed {call}",
    ):
        assert unfinished_functions(hidden, step) == [], hidden
    for seen in (
        f"char quote = '\"'; {call} char other = '\"';",
        f"char quote = '\\''; {call} // '",
        f"long many = 1'000'000; {call} // 1'0",
        f'auto text = R"(")"; {call} auto more = "";',
        f'auto text = u8R"//(")//"; {call}',
        f'auto text = "//"; {call}',
        f'auto text = "\\\\"; {call} auto more = "//";',
        f'auto text = LR"(\\)"; {call}',
        f"int a = b /*c*// d; {call}",
        'RAYSTEPS_\\\nTODO /* why */ ("02-inter\\\nsection", // where\n "f")',
    ):
        assert unfinished_functions(seen, step) == ["f"], seen


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("int a = 1'000;", "int a = 1'000 ; // '", True),
        ("int a = 1'000;", "int a = 1000;", False),
        ("f('a', 'b')", "f('a','b')", True),
        ("f('\"', x, '\"')", "f('\"',  x, '\"')", True),
        ('f("a b")', 'f("ab")', False),
        ('f("a\\\nb")', 'f("ab")', True),
        ('R"(a b)"', 'R"(ab)"', False),
        ('R"(a\\\nb)"', 'R"(ab)"', False),
        ('R"(// a)"', 'R"(// b)"', False),
        ("int ab;", "int a b;", False),
        ("int a\\\nb;", "int ab;", True),
        ("int a; // it's", "int a; // isn't", True),
        ("#define A b\nc", "#define A b c", False),
        ("#define A b \\\n c\n", "#define A b c\n", True),
        ("int a;\r\nint b;\r\n", "int a; int b;", True),
        ('x = y /* " */ + 1; // "', "x = y + 1;", True),
        ("a = 0x1p+3 + 1.e-5f;", "a=0x1p+3+1.e-5f;", True),
        ("a = u8'x' + L'y';", "a = u8'x'+L'y';", True),
    ],
)
def test_what_is_the_same_code(one: str, other: str, same: bool) -> None:
    assert same_code(one, other) is same
    assert same_code(other, one) is same


@pytest.mark.parametrize("piece", ['R"a(', "/*", '"', "'", "\\\n", "\\", "1'", "/\\\n", "a\\\n", "#\n", "((((", '"\\'])
def test_no_source_takes_long_to_read(piece: str) -> None:
    start = time.thread_time()
    assert not same_code(piece * (1_000_000 // len(piece)), "int a;")
    assert time.thread_time() - start < 5


def test_which_functions_are_called() -> None:
    source = """
    Ray shadow_ray(const HitRecord& hit) { RAYSTEPS_TODO("04-shadows", "shadow_ray"); return {}; }
    bool is_lit(const HitRecord& hit) { return !scene.occluded(shadow_ray(hit), 1.0F); }  // is_lit(hit)
    std::optional<HitRecord> Sphere::intersect(const Ray& ray) const { return std::nullopt; }
    """
    assert called_functions(source, ("shadow_ray", "is_lit", "Sphere::intersect")) == {"shadow_ray"}


@pytest.mark.parametrize(
    ("source", "used"),
    [
        ("float far(float x) { return x; }", False),
        ("float far(float);\nfloat raysteps::far(float x);", False),
        ("[[nodiscard]] std::optional<HitRecord> far(const Ray& ray) {", False),
        ("namespace { std::vector<int>& far() {", False),
        ("std::array<Box, 8> far(const Box& box) {", False),
        ('extern "C" float far(float);', False),
        ("struct A {\npublic:\n    float far() const;", False),
        ("void f() { far(1); }", True),
        ("Ray f() { return {a, b, far(1)}; }", True),
        ("void f() { switch (a) { case 1: far(1); } }", True),
        ("void f() { switch (a) { default: far(1); } }", True),
        ("void f() { ok && far(1); }", True),
        ("bool f() { return not far(1); }", True),
        ("using raysteps::far;", True),
        ("void f() { raysteps::far(1); }", True),
        ("void f() { return far(1); }", True),
        ("void f() { if (b) a(); else far(1); }", True),
        ("float f() { float k = 2.0F * far(1); }", True),
        ("float f() { return a > far(1); }", True),
        ("void f() { auto* g = &far; }", True),
        ('// far(1)\nconst char* text = "far(1)";', False),
    ],
)
def test_where_a_name_is_used_and_where_declared(source: str, used: bool) -> None:
    assert [source[at : at + 3] for _, at in uses(source, {"far"})] == ["far"] * used


@pytest.mark.parametrize(("source", "borrowed"), [("int f() { return far(1); }", True), ("int far(int);\n", False)])
def test_a_name_is_borrowed_where_the_source_has_none_of_its_own(source: str, borrowed: bool) -> None:
    assert (borrowed_functions(source, {"far"}) == {"far"}) is borrowed
    assert not borrowed_functions(f"#if 0\n{source}\n#endif\n", {"far"})
    assert not borrowed_functions(f"int far(int x) {{ return x; }}\n{source}", {"far"})


def test_a_stub_calls_none_of_its_functions(project: Project) -> None:
    """Nothing that is wrong there waits for another function."""
    for step in kit_steps(project):
        assert called_functions(stub_for(project, step), step.functions) == set()
