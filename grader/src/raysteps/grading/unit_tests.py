"""The visible tests of a step, run so that a crash in one of them does not hide the rest, and those of functions that
are not written yet stand aside.
"""

import re
from collections.abc import Collection, Iterable, Mapping, Sequence

from raysteps.common.text import in_seconds, join_and
from raysteps.course.manifest import Step
from raysteps.course.stubs import called_functions, unfinished_functions
from raysteps.images.render import ENDLESS
from raysteps.results.model import HiddenResult, ImageResult, StepResult, TestResult
from raysteps.sandbox.task import Output, Sandbox, TaskResult, Word
from raysteps.toolchain.catch2 import TestOutcome, parse_report
from raysteps.toolchain.compile import Program
from raysteps.toolchain.limits import StepLimits

_MAX_HANGS = 6  # tests that are waited for; a clock would say something else each time
_FIND_THE_LINE = "A debugger stops at the line; docs/where-students-work.md says how to start one."
_SPECIAL = re.compile(r'([\\,\["])')


def _run(sandbox: Sandbox, program: Program, limits: StepLimits, most: float, only: str | None = None) -> TaskResult:
    words: tuple[Word, ...] = ("-r", "xml", "-o", Output("report"))
    if only is not None:
        words += (_SPECIAL.sub(r"\\\1", only),)
    return sandbox.run(program.task(words, limits.of_program(most)))


def _complete(ran: TaskResult, names: Iterable[str]) -> list[TestOutcome] | None:
    """A report that holds exactly the expected test cases, from a program that ended as reports do."""
    cases = parse_report(ran.outputs.get("report", b""))
    ended = not (ran.outcome.timed_out or ran.stopped or ran.outcome.code < 0)
    if not ended or cases is None or sorted(case.name for case in cases) != sorted(names):
        return None
    return cases


def _result(case: TestOutcome) -> TestResult:
    if case.passed:
        return TestResult(case.name, True)
    if case.failure is None:
        return TestResult(case.name, False, "The test failed without an assertion.", outcome="wrong")
    failure = case.failure
    return TestResult(
        case.name,
        False,
        failure.notes,
        failure.expected,
        failure.got,
        failure.location,
        "wrong",
    )


def _result_alone(ran: TaskResult, name: str) -> TestResult:
    cases = _complete(ran, [name])
    if cases is not None:
        return _result(cases[0])
    if ran.hung:
        message = f"The test was stopped after {in_seconds(ran.outcome.seconds)}. {ENDLESS}"
        return TestResult(name, False, message, outcome="timeout")
    return TestResult(name, False, _why_cut_short(ran), outcome="crashed")


def _why_cut_short(ran: TaskResult) -> str:
    """What ended the program in the middle of a test, and how to find it."""
    if ran.stopped == "memory":
        return "The test needed more memory than a program may have here. Does a list or a recursion grow without end?"
    words = ran.outcome.signal_words
    if words is not None:
        return f"The program crashed in the middle of the test ({words}). {_FIND_THE_LINE}"
    return f"The program ended in the middle of the test, with exit code {ran.outcome.code}. {_FIND_THE_LINE}"


def run_tests(sandbox: Sandbox, program: Program, names: Sequence[str], limits: StepLimits) -> list[TestResult]:
    """All test cases in one process; when that ends badly, each in a process of its own."""
    ran = _run(sandbox, program, limits, limits.seconds)
    together = _complete(ran, names)
    limits = limits.after_a_timeout() if ran.hung else limits
    if together is not None:
        found = {case.name: _result(case) for case in together}
        return [found[name] for name in names]
    results: list[TestResult] = []
    for name in names:
        if sum(result.outcome == "timeout" for result in results) >= _MAX_HANGS:
            results.append(TestResult(name, False, "There was no time left for this test.", outcome="timeout"))
        else:
            results.append(_result_alone(_run(sandbox, program, limits, limits.seconds, name), name))
            limits = limits.after_a_timeout() if results[-1].outcome == "timeout" else limits
    return results


# What waits for functions that are not written yet.


def not_written_yet(functions: Sequence[str]) -> str:
    """In words."""
    return f"Not written yet: {join_and(functions)}."


def _missing(step: Step, functions: Sequence[str], unfinished: Sequence[str], called: Collection[str]) -> str:
    """The function for which these wait: one of them, or one before them that the source calls."""
    first = min((step.functions.index(name) for name in functions), default=0)
    needed = [*(name for name in unfinished if name in functions), *(n for n in step.functions[:first] if n in called)]
    return needed[0] if needed else ""


def set_aside(
    result: StepResult,
    step: Step,
    tests: Mapping[str, Sequence[str]],
    source: str,
    *,
    replaced: bool = False,
) -> None:
    """Where a RAYSTEPS_TODO is left, what failed says what it waits for, and such tests come last. `tests`: the
    functions of each; `replaced`: the reference's functions stood in for those that are not written."""
    unfinished = unfinished_functions(source, step)
    called = set() if replaced else called_functions(source, unfinished)
    for test in result.tests:
        missing = "" if test.passed else _missing(step, tests[test.name], unfinished, called)
        if missing:
            test.waits_for, test.message = missing, f"It waits for {missing}, not written yet."
            test.expression = test.expanded = test.location = ""
    aside = [(test.waits_for, *tests[test.name]) for test in result.tests if test.waits_for]
    waiting = [name for name in unfinished if any(name in names for names in aside)]
    written = [name for name in unfinished if name not in waiting]
    for item in result.hidden:
        if item.kind == "function" and not item.passed:
            item.waits_for = _missing(step, [item.name], unfinished, called)
    pictures: list[ImageResult | HiddenResult] = [*result.images]
    pictures += [item for item in result.hidden if item.kind == "picture"]
    for picture in pictures:
        if waiting and not picture.passed:
            picture.waits_for, picture.message = waiting[0], f"It waits for {waiting[0]}, not written yet."
    result.tests.sort(key=lambda test: bool(test.waits_for))
    if waiting:
        result.messages.append(not_written_yet(waiting))
    if waiting and replaced:
        result.messages.append("Your other functions are tried with the reference's in place of what is not written.")
    if written:
        result.messages.append(f"RAYSTEPS_TODO is still in: {join_and(written)}. The tests pass: delete that line.")
