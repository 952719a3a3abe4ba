"""The line at which a student's own code crashed or hung, found with sanitizers."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from conftest import Sources

from raysteps.common.process import Outcome
from raysteps.course.manifest import Step
from raysteps.grading import unit_tests
from raysteps.grading.self_check import name_crash
from raysteps.grading.unit_tests import FIND_THE_LINE, crash_line, hang_line, has_crashed, tell_crash_line
from raysteps.results.model import StepResult, TestResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Isolation, Task, TaskResult
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import Program
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import limits_of
from raysteps.watch.worker import QuickLook

_ID = "02-intersection"
_FIRST = "    std::optional<HitRecord> closest;\n"  # the beginning of closest_hit in the reference

# Each ends a program without sanitizers, too.
_CRASHES = {
    "index": ("std::vector<int> few(3); if (few[surfaces.size() + 900000000]) return closest;", "beyond its end"),
    "heap": ("std::vector<int> few(3); for (int i = 0; i < 900000000; ++i) few.data()[i] = i;", "writes an element"),
    "null": ("const Surface* none = nullptr; if (none->hit(ray)) return closest;", "follows a null pointer"),
    "wild": ("volatile std::size_t far = 1UL << 40; if (surfaces.data()[far]->hit(ray)) return closest;", "nowhere"),
    "twice": ("int* volatile gone = new int(1); delete gone; delete gone;", "gives it back twice"),
    "zero": ("volatile int none = 0; if (5 / none) return closest;", "divides a whole number by 0"),
    "throws": ("if (surfaces.at(surfaces.size())) return closest;", "throws std::out_of_range"),
    "abort": ("std::abort();", "ends the program with abort()"),
}


@pytest.fixture
def step(steps: list[Step]) -> Step:
    return next(step for step in steps if step.id == _ID)


def _graded(kit: BuiltKit, step: Step, source: str, folder: Path) -> tuple[StepResult, list[str]]:
    """The visible part, as `watch` looks at it, named where it crashed, and what was said while somebody waits."""
    submission, own = Submission("somebody", {step.id: source.encode()}, {}), kit.in_one_process()
    result = QuickLook(own, step, LimitsOnly(), folder, lambda _: None).look(source)
    said: list[str] = []
    name_crash(own, submission, LimitsOnly(), said.append, [result])
    return result, said


def test_a_lambda_and_an_exit(kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path) -> None:
    code = "    if (surfaces.empty()) { std::exit(0); }\n    [&]() noexcept { surfaces.at(surfaces.size()); }();\n"
    result, _ = _graded(kit, step, "#include <cstdlib>\n" + solved[_ID].replace(_FIRST, _FIRST + code, 1), tmp_path)
    cause = "in a lambda: throws std::out_of_range, and nobody catches it."
    assert any(cause in test.message for test in result.tests)
    ended = "The program ended in the middle of the test: exit() was called."
    assert any(test.message.startswith(ended) for test in result.tests)


@pytest.mark.parametrize("name", _CRASHES)
def test_the_line_is_named(kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path, name: str) -> None:
    code, cause = _CRASHES[name]
    source = "#include <cstdlib>\n#include <vector>\n" + solved[_ID].replace(_FIRST, f"{_FIRST}    {code}\n", 1)
    line = source[: source.index(code)].count("\n") + 1
    assert line > 1
    result, said = _graded(kit, step, source, tmp_path)
    messages = [test.message for test in result.tests if "intersection.cpp, line" in test.message]
    assert len(messages) == 1, [test.message for test in result.tests if not test.passed]
    assert f"intersection.cpp, line {line}, in closest_hit: " in messages[0]
    assert cause in messages[0]
    hints = [FIND_THE_LINE in test.message for test in result.tests if has_crashed(test)]
    ended = [test.outcome == "crashed" for test in result.tests if has_crashed(test)]
    assert hints == [False, *ended[1:]], "a debugger finds the lines of the others"
    assert said == [f"{_ID} crashed: looking for the line"]


def test_only_what_is_named_needs_no_debugger(
    kit: BuiltKit, step: Step, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(unit_tests, "crash_line", lambda said, files, *, threw: "hit.cpp, line 7.")
    names = list(kit.tests[_ID])[:3]
    words = [f"It crashed ({name}). {FIND_THE_LINE}" for name in names]
    tests = [TestResult(name, False, said, outcome="crashed") for name, said in zip(names, words, strict=True)]
    found = StepResult(_ID, "crashed", 0, 1, False, tests=tests, messages=["3 of 3 tests failed.", words[0]])
    source = (kit.project.solutions / step.path).read_bytes()
    name_crash(kit.in_one_process(), Submission("a", {_ID: source}, {}), LimitsOnly(), lambda _: None, [found])
    assert [test.message for test in tests] == [f"It crashed ({names[0]}).\nhit.cpp, line 7.", *words[1:]]
    assert found.messages == ["3 of 3 tests failed.", tests[0].message], "the line is told above all checks, too"


def test_what_happened_on_the_line_takes_the_place_of_guesses(
    steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    class Silent:
        isolation = Isolation()

        def run(self, task: Task) -> TaskResult:
            return TaskResult(Outcome(-11, False, "", "", 0.1), {}, 0.1, "")

    line = "a.cpp, line 7, in f: no return."
    monkeypatch.setattr(unit_tests, "crash_line", lambda said, files, *, threw: line)
    guess = "The program crashed (SIGSEGV: memory that is not its own, or a recursion without an end)."
    test = TestResult("a", False, f"{guess} {FIND_THE_LINE}", outcome="crashed")
    assert tell_crash_line(Silent(), Program(("tests",)), test, limits_of(steps[0], {}), ["a.cpp"])
    assert test.message == f"The program crashed (SIGSEGV).\n{line}"


def test_who_does_not_crash_waits_for_nothing(kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path) -> None:
    """A wrong answer is no crash."""
    source = solved[_ID].replace(_FIRST, _FIRST + "    if (surfaces.size() < 90) { return closest; }\n", 1)
    result, said = _graded(kit, step, source, tmp_path)
    assert not all(test.passed for test in result.tests)
    assert said == []


def test_a_crash_that_sanitizers_do_not_meet(kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path) -> None:
    """What was said before stays."""
    test = TestResult(next(iter(kit.tests[_ID])), False, "It crashed.", outcome="crashed")
    found = StepResult(_ID, "failed", 0, 1, False, tests=[replace(test)])
    submission = Submission("somebody", {_ID: solved[_ID].encode()}, {})
    name_crash(kit.in_one_process(), submission, LimitsOnly(), lambda _: None, [found])
    assert found.tests == [test]


def test_the_function_that_does_not_end_is_named(kit: BuiltKit, step: Step, solved: Sources) -> None:
    """And not what it calls again and again."""
    code = "for (std::size_t i = 0; i < surfaces.size() || i > 0;) { if (surfaces[i]->hit(ray)) { i = 0; } }"
    source = solved[_ID].replace(_FIRST, f"{_FIRST}    {code}\n", 1)
    line = source[: source.index(code)].count("\n") + 1
    tests = [test for test, functions in kit.tests[_ID].items() if "closest_hit" in functions]
    test = TestResult(tests[0], False, "It was stopped.", outcome="timeout")
    found = StepResult(_ID, "failed", 0, 1, False, tests=[test])
    said: list[str] = []
    name_crash(kit.in_one_process(), Submission("a", {_ID: source.encode()}, {}), LimitsOnly(), said.append, [found])
    expected = f"intersection.cpp, line {line}, in closest_hit: still at work when it was stopped."
    assert test.message == f"It was stopped.\n{expected}"
    assert said == [f"{_ID} did not end: looking for the line"]


def test_what_did_not_return_has_no_end() -> None:
    def stack(head: str, *frames: tuple[str, int]) -> str:
        lines = [f"    #1 0x1 in raysteps::{name}(int) /k/shadows.cpp:{line}:3\n" for name, line in frames]
        return f"{head}:\n    #0 0x1 in print_sample(int) /k/testing/crash_report.cpp:9:5\n{''.join(lines)}"

    said = stack("still at work", ("hit", 4), ("is_lit", 8), ("light", 20))
    said += stack("still at work", ("is_lit", 9), ("light", 20))
    said += stack("not returned", ("is_lit", 5), ("light", 15))
    expected = "shadows.cpp, lines 8 to 9, in is_lit: still at work when it was stopped."
    assert hang_line(said, ["shadows.cpp"]) == expected
    assert hang_line(said, ["shading.cpp"]) == ""
    seen_elsewhere = stack("still at work", ("hit", 4)) + stack("not returned", ("is_lit", 5))
    assert "shadows.cpp, line 5, in is_lit: " in hang_line(seen_elsewhere, ["shadows.cpp"])
    assert hang_line(stack("still at work", ("hit", 4)), ["shadows.cpp"]) == ""


_STACK = """\
    #0 0x5581 in std::vector<int>::operator[](unsigned long) /usr/include/c++/12/bits/stl_vector.h:1123
    #1 0x5582 in raysteps::hit(raysteps::Ray const&) /tmp/a b/02/intersection.cpp:{line}:9
    #2 0x5583 in main /tmp/framework/main.cpp:3
"""


def test_frames_of_others_are_passed_over() -> None:
    said = "==7==ERROR: AddressSanitizer: heap-buffer-overflow on address 0x1\nREAD of size 4 at 0x1 thread T0\n"
    said += _STACK.format(line=12) + "\nallocated by thread T0 here:\n" + _STACK.format(line=5)
    expected = "intersection.cpp, line 12, in hit: reads an element beyond the end of a list or an array."
    assert crash_line(said, ["intersection.cpp"], threw=False) == expected
    assert crash_line(said, ["shading.cpp"], threw=False) == ""


def test_the_last_exception_is_the_one_that_nobody_caught() -> None:
    said = "".join(f"thrown: {kind}\n" + _STACK.format(line=line) for kind, line in (("int", 1), ("std::bad_alloc", 2)))
    assert (
        crash_line(said, ["intersection.cpp"], threw=True) == "intersection.cpp, line 2, in hit: throws std::bad_alloc."
    )
    assert crash_line(said, ["intersection.cpp"], threw=False) == ""


def test_what_a_program_says_itself_cannot_grow_the_message() -> None:
    said = "thrown: " + "x" * 10_000 + "\x1b[2J\n" + _STACK.format(line=2)
    named = crash_line(said, ["intersection.cpp"], threw=True)
    assert len(named) < 400
    assert re.search(r"[\x00-\x1f]", named) is None


@pytest.mark.parametrize("length", [1_900, 1_000_000])
def test_no_line_of_any_shape_is_waited_for(length: int) -> None:
    """A pattern that tries all ways of splitting it would take hours; so would many lines of a usual length."""
    few = 5_000_000 // length
    said = few * f"    #0 0x1 in {length // 5 * ' in a'}\n"
    said = "thrown: int\n" + said + _STACK.format(line=2)
    assert crash_line(said, ["intersection.cpp"], threw=True).startswith("intersection.cpp, line 2, in hit: ")
    said = "thrown: int\n" + "    #0 0x1" + length // 5 * " in a" + "\n" + _STACK.format(line=2)
    assert crash_line(said, ["intersection.cpp"], threw=True).startswith("intersection.cpp, line 2, in hit: ")


@pytest.mark.parametrize("head", ["ABRT ", "other "])
def test_no_words_of_a_report_are_waited_for(head: str) -> None:
    said = (
        f"==7==ERROR: AddressSanitizer: {head}\n{100_000 * 'overflow'}\n{100_000 * chr(39).join(['Assertion ', ''])}\n"
    )
    assert crash_line(said + _STACK.format(line=2), ["intersection.cpp"], threw=False)


def test_an_unknown_error_is_told_as_it_is() -> None:
    said = "==7==ERROR: AddressSanitizer: {x} {uses}\n" + _STACK.format(line=2)
    assert crash_line(said, ["intersection.cpp"], threw=False) == "intersection.cpp, line 2, in hit: {x}."


def test_a_recursion_is_named_and_not_what_it_called_last() -> None:
    places = [("mirror", 4), ("reflected_ray", 9), ("trace", 15), ("trace", 16), ("trace", 16)]
    frames = [
        f"    #{at} 0x1 in raysteps::{name}(int) /k/reflection.cpp:{line}:3" for at, (name, line) in enumerate(places)
    ]
    head = "==7==ERROR: AddressSanitizer: stack-overflow on address 0x1 (pc 0x2)\n"
    named = crash_line(head + "\n".join(frames) + "\n", ["reflection.cpp"], threw=False)
    assert named == "reflection.cpp, line 15, in trace: calls itself without an end."
    only = crash_line(head + frames[0] + "\n", ["reflection.cpp"], threw=False)
    assert only == "reflection.cpp, line 4, in mirror: calls itself without an end."
