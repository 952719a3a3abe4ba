"""What is said when a step does not build."""

import shutil
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest

from raysteps.common.process import Outcome, run
from raysteps.course.manifest import Step
from raysteps.grading.build_messages import (
    IN_OTHER_WORDS,
    compile_message,
    forbidden_message,
    link_message,
    undefined_message,
    why_not_built,
)
from raysteps.sandbox.task import LimitHit, TaskResult
from raysteps.toolchain.compile import Compiled
from raysteps.toolchain.kit_artifacts import BuiltKit

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
    odd = SOURCE.replace("one;", "one;  //\x0c\u2028\x85\v\rodd").replace("\n", "\r\n")
    shown = compile_message(shadows, odd, ran(output))
    assert shown.endswith("5 | int three;")
    assert all(" | " in line for line in shown.splitlines()[1:])


def test_the_linkers_words_are_told_as_such(shadows: Step) -> None:
    said = "ld: /in/1/step.o: in function `_init':\nshadows.cpp:(.text+0x30): multiple definition of `_init';\n"
    assert "_init is defined twice" in compile_message(shadows, SOURCE, ran(said))
    for warned in ("reference to `_ZN8raysteps5otherEf'", "symbol: _ZN8raysteps5otherEf"):
        said = f"ld: warning: undefined {warned}\nld: final link failed: No space left on device\n"
        assert "missing" not in compile_message(shadows, SOURCE, ran(said)), "what every step asks the kit for"
    for name in ("ccO4Yi4A", "ccwQHJHP"):
        said = f"/tmp/{name}.s: Assembler messages:\n/tmp/{name}.s:7: Error: x"
        assert compile_message(shadows, SOURCE, ran(said)) == "It does not build: temporary.s:7: Error: x"


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


# Wrong lines of a beginner's, and a part of what each should be told.
_WRONG = {
    "glm::vec3 f(glm::vec3 v) { return 2 * v; }": "takes floats only",
    "glm::vec3 f(const glm::vec3& v) { return v / 2.0; }": "takes floats only",
    "float f(float x) { return std::max(0.0, x); }": "of one type",
    "float f(float x) { return glm::clamp(x, 0, 1); }": "of one type",
    "float f(const std::optional<Hit>& hit) { return hit.distance; }": "ask has_value() first",
    "Hit f(const std::optional<Hit>& hit) { return hit; }": "then write * before it",
    "float Hit::twice() { return 2.0F * distance; }": "as the header declares it",
    "void f(float x) { if (x > 0.0F) { x = 0.0F; }\nvoid g() {}": "closing brace is missing",
    "void f(const glm::vec3& v) { v.x = 0.0F; }": "change a copy",
    "void f(const glm::vec3& v) { nope(v); }": "has not met this name above",
    "Sphere f();": "has not met this name above",
    '#include "intersection.h"': "paths begin below the kit's framework",
    "glm::vec3 f(const Hit& v) { return v * v; }": "",
    "void f() { g() }": "has not met this name above",
    "int f(std::vector<glm::vec3> v) { return v * 2; }": "",
    "void f() { int a\nint b = 1; }": "semicolon is missing",
    "int f() { return 1 }": "semicolon is missing",
    "glm::vec3 f(const Hit& h) { return h.distance + 1.0 * 2 * h.distance * glm::vec3{}; }": "takes floats only",
    "float f(float a, float b) { return 2.0F * a ^ b; }": "a power is std::pow",
    "float f(float a) { return a % 2; }": "a remainder std::fmod",
    "const char* f() { return \u201chello\u201d; }": "type it anew",
    "float f(float a) { return 2.0F \u2013 a; }": "is another: type it anew",
    "float f(float a) { return a\u200b; }": "nobody sees",
    "float f(float a) { return \ufeffa; }": "nobody sees",
    "float f(float a) { return \u3164a; }": "nobody sees",
    "int f() { return 1; }\nint f() { return 1; }": "keep one of them",
    "float f(float a, float b, float c) { return std::max(a, b, c); }": "for three write",
}
_BEGIN = "#include <algorithm>\n#include <glm/glm.hpp>\n#include <optional>\n#include <vector>\n"
_BEGIN += "struct Hit { float distance; float twice() const; };\n"
_FOUND = {name: path for name in ("g++", "clang++", "clang++-14") if (path := shutil.which(name))}
_COMPILERS = list({Path(path).resolve(): name for name, path in _FOUND.items()}.values())  # each once


@pytest.mark.parametrize("wrong", _WRONG)
@pytest.mark.parametrize("compiler", _COMPILERS)
def test_beginners_are_told_in_other_words(shadows: Step, tmp_path: Path, compiler: str, wrong: str) -> None:
    source = tmp_path / "shadows.cpp"
    source.write_text(f"{_BEGIN}{wrong}\n")
    words: list[str | Path] = [compiler, "-std=c++20", "-fsyntax-only", "-fno-diagnostics-color", source]
    output = run(words, seconds=60).stderr
    if "'glm/glm.hpp' file not found" in output or "glm/glm.hpp: No such file" in output:
        pytest.skip("glm is not where this compiler looks")
    message = compile_message(shadows, source.read_text(), ran(output))
    told = {words for _, words in IN_OTHER_WORDS if words in message.splitlines()}
    assert [_WRONG[wrong] in one for one in told] == ([True] if _WRONG[wrong] else [])


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("C2677: binary '*': no global operator found which takes type 'glm::vec3' and 'int'", "takes floats only"),
        ("C2672: 'std::max': no matching overloaded function found", "of one type"),
        ("C2039: 'distance': is not a member of 'std::optional<raysteps::Hit>'", "ask has_value() first"),
        ("C2511: 'float Hit::twice(void)': overloaded member function not found in 'Hit'", "as the header declares it"),
        ("C1075: '{': no matching token found", "closing brace is missing"),
        ("C2039: 'sqrtt': is not a member of 'std'", "declares it included"),
        ("C2819: type 'Hit' does not have an overloaded member 'operator ->'", "in place of ->"),
        ("C2440: 'return': cannot convert from 'float' to 'glm::vec3'", "another is asked for"),
        ("C2440: 'return': cannot convert from 'std::optional<raysteps::Hit>' to 'raysteps::Hit'", "write * before it"),
        ("C2664: 'f': cannot convert argument 1 from 'std::optional<Hit>' to 'const Hit &'", "write * before it"),
        ("C2664: 'f': cannot convert argument 1 from 'float' to 'std::optional<Hit>'", "another is asked for"),
        ("C2146: syntax error: missing ';' before identifier 'b'", "semicolon is missing"),
        ("C2296: '^': illegal, left operand has type 'float'", "a power is std::pow"),
        ("C2084: function 'int f(void)' already has a body", "keep one of them"),
        ("C3490: 'x' cannot be modified because it is being accessed through a const object", "change a copy"),
    ],
)
def test_microsofts_compiler_is_told_in_other_words(shadows: Step, said: str, told: str) -> None:
    assert told in compile_message(shadows, SOURCE, ran(f"C:\\kit\\shadows.cpp(4): error {said}\n")).splitlines()[4]


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (["'Ray' does not name a type", "expected declaration before '}' token"], "one } too many"),
        (["extraneous closing brace ('}')"], "one } too many"),
        (["base operand of '->' has non-pointer type 'const Hit'"], "write . in place of ->"),
        (["member reference type 'const Hit' is not a pointer; did you mean to use '.'?"], "write . in place of ->"),
        (["'cout' is not a member of 'std'"], "declares it included"),
        (["no member named 'cout' in namespace 'std'"], "declares it included"),
        (["could not convert 'h' from 'const Hit' to 'glm::vec3' {aka 'glm::vec<3>'}"], "another is asked for"),
        (["no viable conversion from returned value of type 'const Hit' to function return type"], "is asked for here"),
        (["could not convert 'maybe()' from 'std::optional<Hit>' to 'Hit'"], "write * before it"),
        (["could not convert 'hit' from 'Hit' to 'std::optional<float>'"], "another is asked for"),
        (["could not convert 'hit' from 'std::optional<Hit>' to 'std::optional<float>'"], "another is asked for"),
        (["conversion from 'std::optional<Hit>' to non-scalar type 'Hit' requested"], "write * before it"),
        (["cannot convert 'const std::optional<Hit>' to 'float' in return"], "write * before it"),
        (
            ["invalid initialization of reference of type 'const Hit&' from expression of type 'std::optional<Hit>'"],
            "write * before it",
        ),
        (["no match for 'operator>' (operand types are 'std::optional<Hit>' and 'float')"], "write * before it"),
        (["no viable conversion from 'const std::optional<Hit>' to 'Hit'"], "write * before it"),
        (["invalid operands to binary expression ('float' and 'const std::optional<Hit>')"], "write * before it"),
        (["conversion from 'Hit' to non-scalar type 'Other' requested"], "another is asked for"),
        (["cannot convert 'glm::vec3' {aka 'glm::vec<3>'} to 'float' in return"], "another is asked for"),
        (["no match for 'operator=' (operand types are 'Hit' and 'Other')"], "another is asked for"),
        (["no match for 'operator=' (operand types are 'std::optional<Hit>' and 'float')"], "another is asked for"),
        (["no match for 'operator=' (operand types are 'Hit' and 'std::optional<Hit>')"], "write * before it"),
        (["no viable overloaded '='"], "another is asked for"),
        (["cannot initialize return object of type 'float' with an lvalue of type 'float *'"], "another is asked for"),
        (["assigning to 'float' from incompatible type 'float *'"], "another is asked for"),
        (["'unordered_map' in namespace 'std' does not name a template type"], "declares it included"),
        (["no template named 'unordered_map' in namespace 'std'"], "declares it included"),
        (["no type named 'ofstream' in namespace 'std'"], "declares it included"),
        (["'vector' does not name a template type"], "has not met this name above"),
    ],
)
def test_gcc_and_clang_are_told_in_other_words(shadows: Step, said: list[str], told: str) -> None:
    output = "".join(f"shadows.cpp:4:1: error: {one}\n" for one in said)
    assert told in compile_message(shadows, SOURCE, ran(output)).splitlines()[5]


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
        (
            ran("ld: step.o: no such version\nld: bad value\ncollect2: error: ld returned 1 exit status"),
            "It does not build: ld: step.o: no such version",
        ),
        (
            ran("cc1plus: fatal error: a: No such file or directory\ncompilation terminated."),
            "It does not build: cc1plus: fatal error: a: No such file or directory",
        ),
        (
            ran("g++: internal compiler error: File size limit exceeded signal terminated program as\nSee <file:///x>"),
            "It does not build: what the compiler makes of it is larger than a file may be. Is there a huge array?",
        ),
        (
            ran("/usr/bin/ld: step.o: in function `f()':\nshadows.cpp:(.text+0x8): relocation truncated to fit: R_X86"),
            "It does not build: its variables take more than 2 GB. Is there a huge array?",
        ),
        (ran("/in/1/shadow_ray.cpp:8: error: no"), "It does not build: shadow_ray.cpp:8: no"),
        (ran(""), "It does not build: the compiler gave up and said nothing."),
        (ran("", stopped="memory"), "It does not build: the compiler needed more memory than it may have."),
    ],
)
def test_other_ends_of_a_compiler(shadows: Step, said: TaskResult, expected: str) -> None:
    assert compile_message(shadows, SOURCE, said) == expected


def test_a_compiler_that_was_stopped(shadows: Step) -> None:
    message = compile_message(shadows, SOURCE, ran("", stopped="wall", seconds=60.2))
    assert message.startswith("It does not build: the compiler was stopped after 60 s")


def test_a_linker_that_is_stopped_is_told_as_such() -> None:
    stopped = ran("")
    assert link_message(replace(stopped, stopped="cpu")) == "It does not build: the linker took too long."
    assert "more memory" in link_message(replace(stopped, stopped="memory"))


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
    assert link_message(ran(output)).startswith("It does not build: shadow_ray(int) is missing.")


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("Color Specular(const Fill& fill) {\n}", "The file has Specular: is that meant to be specular?"),
        ("Color specula(const Fill& fill) {\n}", "The file has specula: is that meant to be specular?"),
        ("Color specular(int fill) {\n}", "The file has specular, but with other arguments than the header's"),
        ("inline Color specular(const Fill& fill) {\n}", "The file has specular, but marked as inline, so that only"),
        ("Color other(int fill);", ""),
        ("\n\n", "The file is empty. Was it saved?"),
        ("// nothing yet\n\n", "nothing but comments. Is the code commented out?"),
        ('#include "steps/02-intersection/intersection.hpp"\nint f() { return 1; }', "is it that step's, saved"),
        ('#include "steps/02-a/a.hpp"\n#include "steps/04-shadows/shadows.hpp"\nint f() { return 1; }', ""),
        ('#include "steps/02-a/a.hpp"\n#include <steps/04-shadows/shadows.hpp>\nint f() { return 1; }', ""),
        ('#include "steps/02-a/a.hpp"\nColor specula() { return {}; }', "is that meant to be specular?"),
    ],
)
def test_a_missing_function_is_told_as_the_header_has_it(shadows: Step, source: str, told: str) -> None:
    vector = "glm::vec<3, float, (glm::qualifier)0>"
    span = "std::span<raysteps::Light const, 18446744073709551615ul>"
    name = f"raysteps::specular(raysteps::Fill const&, {span}, {vector} const&)"
    compiled = Compiled(None, ran(""), missing=(name,))
    first, *more = why_not_built(cast(BuiltKit, None), shadows, compiled, source).splitlines()
    assert "specular(const Fill&, std::span<const Light>, const glm::vec3&) is missing" in first
    assert told in "".join(more)
    assert bool(more) == bool(told)


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (
            'x.obj : error LNK2019: unresolved external symbol "bool __cdecl raysteps::f(int)" (?f) referenced',
            " f(int) is missing",
        ),
        (
            'y.obj : error LNK2005: "int __cdecl raysteps::f(int)" (?f@@YA) already defined in x.obj',
            "raysteps::f(int) is defined twice",
        ),
    ],
)
def test_microsofts_linker_is_understood(said: str, told: str) -> None:
    message = link_message(TaskResult(Outcome(1, False, said, "", 1.0), {}, 1.0, ""))
    assert told in message


def test_a_step_that_reaches_for_what_is_not_its_own(steps: list[Step]) -> None:
    shadows, octree, bvh = steps[3], steps[5], steps[8]
    owners = {"_ZN8raysteps5splitE": (octree, "raysteps::split(raysteps::Box const&)")}
    assert forbidden_message(shadows, tuple(owners), owners).endswith(
        "a function of step 06-octree, which comes later."
    )
    assert "09-bvh may not call split of step 06-octree" in forbidden_message(bvh, tuple(owners), owners)
    owners["_ZN8raysteps4joinE"] = (octree, "raysteps::join(int)")
    assert "may not call split and join of step 06-octree, which do" in forbidden_message(bvh, tuple(owners), owners)
    assert "counters" in forbidden_message(shadows, ("_ZN8raysteps7t_statsE",), owners)
    assert "not for the steps" in forbidden_message(shadows, ("_ZN5Catch4failE",), owners)


def test_one_helper_is_called_and_two_are() -> None:
    assert undefined_message(("helper(int)",)).startswith("It does not build: helper(int) is called, but")
    assert undefined_message(("a()", "b()")).startswith("It does not build: a() and b() are called, but")
