"""The visible tests of a step, run so that a crash in one of them does not hide the rest, and those of functions that
are not written yet stand aside.
"""

import re
from collections.abc import Iterable, Mapping, Sequence

from raysteps.common.text import in_seconds, join_and
from raysteps.images.render import ENDLESS, describe_exit
from raysteps.results.model import StepResult, TestResult
from raysteps.sandbox.task import Output, Sandbox, TaskResult, Word
from raysteps.toolchain.catch2 import TestOutcome, parse_report
from raysteps.toolchain.compile import Program
from raysteps.toolchain.limits import StepLimits

_MAX_HANGS = 6  # tests that are waited for; a clock would say something else each time
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
        failure.expression,
        failure.expanded,
        failure.location,
        "wrong",
    )


def _result_alone(ran: TaskResult, name: str) -> TestResult:
    cases = _complete(ran, [name])
    if cases is not None:
        return _result(cases[0])
    if ran.outcome.timed_out or ran.stopped in ("wall", "cpu"):
        message = f"The test was stopped after {in_seconds(ran.outcome.seconds)}. {ENDLESS}"
        return TestResult(name, False, message, outcome="timeout")
    if ran.outcome.signal_name is not None or ran.stopped:
        return TestResult(name, False, describe_exit(ran, "The test's report")[1], outcome="crashed")
    return TestResult(name, False, "The program ended before the test was over.", outcome="crashed")


def run_tests(sandbox: Sandbox, program: Program, names: Sequence[str], limits: StepLimits) -> list[TestResult]:
    """All test cases in one process; when that ends badly, each in a process of its own."""
    ran = _run(sandbox, program, limits, limits.seconds)
    together = _complete(ran, names)
    limits = limits.after_a_timeout() if ran.outcome.timed_out or ran.stopped in ("wall", "cpu") else limits
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


def not_written_yet(functions: Sequence[str]) -> str:
    """In words."""
    return f"Not written yet: {join_and(functions)}."


def set_aside(result: StepResult, tests: Mapping[str, Sequence[str]], unfinished: Sequence[str]) -> None:
    """Failed tests of functions that still hold a RAYSTEPS_TODO come last and say what they wait for. `tests`: the
    functions of each."""
    waiting = set()
    for test in result.tests:
        left = [name for name in tests[test.name] if name in unfinished and not test.passed]
        if left:
            test.waits_for, test.expression, test.expanded, test.location = left[0], "", "", ""
            test.message = f"It waits for {join_and(left)}, not written yet."
        waiting.update(left)
    result.tests.sort(key=lambda test: bool(test.waits_for))
    if waiting:
        result.messages.append(not_written_yet([name for name in unfinished if name in waiting]))
    written = [name for name in unfinished if name not in waiting]
    if written:
        result.messages.append(f"RAYSTEPS_TODO is still in: {join_and(written)}. The tests pass: delete that line.")
