"""Runs the visible tests of a step, so that a crash in one of them does not hide the rest."""

import re
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome, run
from raysteps.common.text import number
from raysteps.grading.catch_report import TestOutcome, parse_report
from raysteps.grading.results import TestResult

_SPECIAL = re.compile(r'([\\,\["])')


@dataclass(frozen=True)
class _Run:
    outcome: Outcome
    cases: list[TestOutcome] | None


def _run(program: Path, seconds: float, only: str | None = None, memory_mb: int | None = None) -> _Run:
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        report = Path(folder) / "report.xml"
        command: list[str | Path] = [program, "-r", "xml", "-o", report]
        if only is not None:
            command.append(_SPECIAL.sub(r"\\\1", only))
        outcome = run(command, seconds=seconds, cwd=Path(folder), memory_mb=memory_mb)
        return _Run(outcome, None if outcome.timed_out else parse_report(report))


def expected_cases(program: Path) -> list[str]:
    """The names of all test cases, as the reference runs them; it must pass every one."""
    result = _run(program, 600)
    if result.cases is None or not result.cases:
        raise GraderFault(f"{program.name} gave no complete report")
    failed = [case.name for case in result.cases if not case.passed]
    if failed:
        raise GraderFault(f"the reference fails its own tests: {failed[0]}")
    return [case.name for case in result.cases]


def _is_complete(result: _Run, names: list[str]) -> bool:
    """A report that holds exactly the expected test cases, from a program that ended as reports do."""
    if result.cases is None or result.outcome.code < 0:
        return False
    return sorted(case.name for case in result.cases) == sorted(names)


def _result(case: TestOutcome) -> TestResult:
    if case.passed:
        return TestResult(case.name, True)
    if case.failure is None:
        return TestResult(case.name, False, "The test failed without an assertion.", outcome="wrong")
    failure = case.failure
    return TestResult(
        case.name,
        False,
        failure.notes or "The test expects something else.",
        failure.expression,
        failure.expanded,
        failure.location,
        "wrong",
    )


def _result_alone(result: _Run, name: str, seconds: float) -> TestResult:
    if result.outcome.timed_out:
        message = f"The test was stopped after {number(seconds)} seconds."
        return TestResult(name, False, message, outcome="timeout")
    if result.outcome.signal_name is not None:
        message = f"The program crashed in this test ({result.outcome.signal_name})."
        return TestResult(name, False, message, outcome="crashed")
    if not _is_complete(result, [name]) or result.cases is None:
        return TestResult(name, False, "The program ended before the test was over.", outcome="crashed")
    return _result(result.cases[0])


def run_tests(program: Path, names: list[str], seconds: float, memory_mb: int | None = None) -> list[TestResult]:
    """All test cases in one process; when that ends badly, each in a process of its own."""
    together = _run(program, seconds, memory_mb=memory_mb)
    if _is_complete(together, names) and together.cases is not None:
        found = {case.name: _result(case) for case in together.cases}
        return [found[name] for name in names]
    each = max(2.0, seconds / 4)
    deadline = time.monotonic() + 3 * seconds
    results = []
    for name in names:
        if time.monotonic() > deadline:
            results.append(TestResult(name, False, "There was no time left for this test.", outcome="timeout"))
        else:
            results.append(_result_alone(_run(program, each, name, memory_mb), name, each))
    return results
