"""Reads the XML report of Catch2, version 2 or 3."""

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path
from xml.etree.ElementTree import Element

from defusedxml.ElementTree import fromstring

from raysteps.common.errors import GraderFault
from raysteps.common.process import run
from raysteps.common.text import printable, shorten

_MAX_BYTES = 2 << 20
_MAX_TAGS = 50_000  # a report of our tests has some hundred
_MAX_SECTIONS = 50  # one in the other; ours are two or three
_MAX_NOTES = 8000  # characters


@dataclass(frozen=True)
class Failure:
    """What a failed test case says."""

    expression: str
    expanded: str
    location: str
    notes: str


@dataclass(frozen=True)
class TestOutcome:
    """One test case."""

    __test__ = False  # not a test class for pytest

    name: str
    passed: bool
    failure: Failure | None = None
    tags: tuple[str, ...] = ()


def _text(element: Element | None) -> str:
    return shorten(printable((element.text or "").strip())) if element is not None else ""


def _location(element: Element) -> str:
    name = element.get("filename", "").replace("\\", "/").rpartition("/")[2]
    place = f"{name}:{element.get('line', '')}" if name else ""
    return shorten(" ".join(printable(place).split()), 200)


_NEGATED = re.compile(r"!\((?P<asked>.+)\)", re.DOTALL)


def _compared(element: Element) -> tuple[str, str]:
    """What was asked for, and what came instead; `!(f())` and `!true` as people say it."""
    original, expanded = _text(element.find("Original")), _text(element.find("Expanded"))
    asked = _NEGATED.fullmatch(original)
    if asked is not None and expanded in ("!true", "!(true)"):
        return f"{asked['asked']} is false", "true"
    return original, expanded


def _joined(notes: list[str]) -> str:
    return shorten("\n".join(notes), _MAX_NOTES)


def _failure(element: Element, notes: list[str]) -> Failure | None:
    """Of an element that is an assertion which failed."""
    if element.tag == "Expression" and element.get("success") == "false":
        problem = element.find("Exception")
        if problem is None:
            problem = element.find("FatalErrorCondition")
        original, expanded = _compared(element)
        return Failure(
            original, expanded if problem is None else f"threw: {_text(problem)}", _location(element), _joined(notes)
        )
    if element.tag in ("Failure", "Exception", "FatalErrorCondition"):
        return Failure(element.tag, _text(element), _location(element), _joined(notes))
    return None


def _first_failure(room: Element, sections: tuple[str, ...] = ()) -> Failure | None:
    """With the notes before it; the names of the sections around it are notes, too. Nobody looks deeper than a test of
    ours goes."""
    if len(sections) > _MAX_SECTIONS:
        return None
    notes = list(sections)
    for element in room:
        if element.tag in ("Info", "Warning"):
            notes.append(_text(element))
            continue
        if element.tag == "Section":
            found = _first_failure(element, (*sections, shorten(printable(element.get("name", "")))))
        else:
            found = _failure(element, notes)
        if found is not None:
            return found
        if element.tag == "Expression":
            notes = list(sections)
    return None


def _outcome(case: Element) -> TestOutcome:
    overall = case.find("OverallResult")
    passed = overall is not None and overall.get("success") == "true"
    tags = tuple(re.findall(r"\[([^\[\]]+)\]", case.get("tags", "")))
    return TestOutcome(printable(case.get("name", "")), passed, None if passed else _first_failure(case), tags)


def parse_report(report: bytes) -> list[TestOutcome] | None:
    """The test cases of a complete report; None when the report is missing, cut short or not in order: it may be
    anything where the student's code runs in the process that writes it, as for a course's own step."""
    if len(report) > _MAX_BYTES or report.count(b"<") > _MAX_TAGS:
        return None
    try:
        return _outcomes(fromstring(report))
    except Exception:  # a fault of this reader would show in the reference's report, which is read first
        return None


def _outcomes(root: Element) -> list[TestOutcome] | None:
    totals = root.find("OverallResultsCases")
    if root.tag not in ("Catch", "Catch2TestRun") or totals is None:
        return None
    cases = [*root.findall("TestCase"), *root.findall("Group/TestCase")]
    if len({case.get("name") for case in cases}) != len(cases):
        return None
    outcomes = [_outcome(case) for case in cases]
    failed = sum(not outcome.passed for outcome in outcomes)
    if totals.get("successes") != str(len(outcomes) - failed) or totals.get("failures") != str(failed):
        return None
    return outcomes


# The visible test cases of a step, as the reference runs them.

_SECONDS = 600


def list_tests(program: Path) -> dict[str, tuple[str, ...]]:
    """Their names with their tags; the reference must pass every one."""
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        report = Path(folder) / "report.xml"
        run([program, "-r", "xml", "-o", report], seconds=_SECONDS, cwd=Path(folder))
        cases = parse_report(report.read_bytes() if report.is_file() else b"")
    if not cases:
        raise GraderFault(f"{program.name} gave no complete report")
    failed = [case.name for case in cases if not case.passed]
    if failed:
        raise GraderFault(f"the reference fails its own tests: {failed[0]}")
    return {case.name: case.tags for case in cases}
