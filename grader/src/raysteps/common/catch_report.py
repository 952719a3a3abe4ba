"""Reads the XML report of Catch2, version 2 or 3."""

import re
from dataclasses import dataclass
from xml.etree.ElementTree import Element, ParseError

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import fromstring

from raysteps.common.text import printable, shorten

_MAX_BYTES = 2 << 20
_MAX_TAGS = 50_000  # a report of our tests has some hundred
_TAG = re.compile(r"\[([^\]]*)\]")


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
    tags: frozenset[str] = frozenset()


def _text(element: Element | None) -> str:
    return shorten(printable((element.text or "").strip())) if element is not None else ""


def _location(element: Element) -> str:
    name = element.get("filename", "").replace("\\", "/").rpartition("/")[2]
    place = f"{name}:{element.get('line', '')}" if name else ""
    return shorten(" ".join(printable(place).split()), 200)


def _first_failure(case: Element) -> Failure | None:
    notes: list[str] = []
    for element in case.iter():
        if element.tag in ("Info", "Warning"):
            notes.append(_text(element))
        elif element.tag == "Expression" and element.get("success") == "false":
            problem = element.find("Exception")
            if problem is None:
                problem = element.find("FatalErrorCondition")
            thrown = f"threw: {_text(problem)}" if problem is not None else _text(element.find("Expanded"))
            return Failure(_text(element.find("Original")), thrown, _location(element), "\n".join(notes))
        elif element.tag in ("Failure", "Exception", "FatalErrorCondition"):
            return Failure(element.tag, _text(element), _location(element), "\n".join(notes))
        elif element.tag == "Expression":
            notes.clear()
    return None


def _outcome(case: Element) -> TestOutcome:
    overall = case.find("OverallResult")
    passed = overall is not None and overall.get("success") == "true"
    tags = frozenset(_TAG.findall(case.get("tags", "")))
    return TestOutcome(printable(case.get("name", "")), passed, None if passed else _first_failure(case), tags)


def parse_report(report: bytes) -> list[TestOutcome] | None:
    """The test cases of a complete report; None when the report is missing, cut short or not in order."""
    if len(report) > _MAX_BYTES or report.count(b"<") > _MAX_TAGS:
        return None
    try:
        root = fromstring(report)
    except (ParseError, DefusedXmlException, ValueError):
        return None
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
