"""Reads the XML report of Catch2, version 2 or 3."""

import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
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

    expected: str
    got: str
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


# What was expected and what came instead, as a person says it: `frame.up = (0, 1, 0)`. Values may hold what a student's
# function gave, so each text is read once, from left to right.

_BINARY = re.compile(r"[()\[\]{}]|,\s|\s(?:==|!=|<=|>=|<|>)\s")
_NEGATED = re.compile(r"!\((?P<asked>.+)\)", re.DOTALL)
_FLOAT = re.compile(r"(?<![\w.])(\d[\d.]{0,40}(?:e[-+]\d{1,4})?|nan|inf)f(?!\w)")  # as Catch2 writes 0.5f, nanf
_LITERAL = re.compile(r"(?<![\w.])(\d[\d.]{0,40}?(?:e[-+]?\d{1,4})?)(?:\.0)?F(?!\w)")  # as a test writes 0.5F and 5.0F
_QUALIFIER = re.compile(r"\b(?:glm|std)::(?:vector<\w{1,40}>(?=\{))?")
_CAST = re.compile(r"static_cast<[\w:]{1,40}>\(([\w.]{1,40})\)")
_HEX = re.compile(r" \(0x[0-9a-f]{1,16}\)")
_MATCHED = " is expected to "  # of the matchers in framework/testing
_VERBS = {"be ": "= ", "have ": "has ", "point ": "points "}


def _value(text: str) -> str:
    """Without what only Catch2 and C++ need."""
    return _HEX.sub("", _FLOAT.sub(r"\1", text.strip()))


def _name(text: str) -> str:
    """What a test calls what it asks, without what only C++ needs: `sphere.intersect({{0, 0, 5}, -down})`."""
    return _LITERAL.sub(r"\1", _CAST.sub(r"\1", _QUALIFIER.sub("", text.strip())))


def _note(text: str) -> str:
    """One that holds a value, `radius := 2.5f`, without what only C++ needs."""
    name, assigned, value = text.partition(" := ")
    return f"{name}{assigned}{_value(value)}" if assigned else text


def _marks(text: str) -> Iterator[re.Match[str]]:
    """The commas and comparisons that stand in no brackets."""
    depth = 0
    for found in _BINARY.finditer(text):
        if found[0] in "([{":
            depth += 1
        elif found[0] in ")]}":
            depth -= 1
        elif depth == 0:
            yield found


def _split(text: str) -> tuple[str, str, str] | None:
    """What stands left of the comparison, the comparison, and what stands right of it."""
    found = next((mark for mark in _marks(text) if mark[0][0] != ","), None)
    return (text[: found.start()], found[0].strip(), text[found.end() :]) if found is not None else None


def _of_matcher(original: str, expanded: str) -> tuple[str, str] | None:
    got, marked, wanted = expanded.rpartition(_MATCHED)
    if not marked:
        return None
    commas = [mark for mark in _marks(original) if mark[0][0] == ","]
    name = original[: commas[-1].start()].strip() if commas else original
    for verb, said in _VERBS.items():
        if wanted.startswith(verb):
            wanted = said + wanted.removeprefix(verb)
    return f"{name} {_value(wanted)}", f"{name} = {_value(got)}"


def _compared(element: Element) -> tuple[str, str]:
    """What was expected, and what came instead, by the name that the test has for it."""
    original, expanded = _name(_text(element.find("Original"))), _text(element.find("Expanded"))
    matched = _of_matcher(original, expanded)
    if matched is not None:
        return matched
    asked, values = _split(original), _split(expanded)
    if asked is not None and values is not None and asked[1] == values[1]:
        sign = "=" if asked[1] == "==" else asked[1]
        return f"{asked[0]} {sign} {_value(values[2])}", f"{asked[0]} = {_value(values[0])}"
    negated = _NEGATED.fullmatch(original)
    if negated is not None and expanded in ("!true", "!(true)"):
        return f"{negated['asked']} = false", f"{negated['asked']} = true"
    if expanded in ("false", "true"):
        return f"{original} = {'true' if expanded == 'false' else 'false'}", f"{original} = {expanded}"
    return original, _value(expanded)


def _joined(notes: list[str]) -> str:
    return shorten("\n".join(notes), _MAX_NOTES)


THREW = "threw: "  # at the start of what came instead
_TROUBLE = {"Exception": THREW, "FatalErrorCondition": "crashed: "}


def _failure(element: Element, notes: list[str]) -> Failure | None:
    """Of an element that is an assertion which failed."""
    if element.tag == "Expression" and element.get("success") == "false":
        problem = element.find("Exception")
        if problem is None:
            problem = element.find("FatalErrorCondition")
        expected, got = _compared(element)
        if problem is not None:
            expected, got = _name(_text(element.find("Original"))), f"{_TROUBLE[problem.tag]}{_text(problem)}"
        return Failure(expected, got, _location(element), _joined(notes))
    if element.tag == "Failure":
        return Failure("", "", _location(element), _joined([*notes, _text(element)]))
    if element.tag in _TROUBLE:
        got = f"{_TROUBLE[element.tag]}{_text(element)}"
        return Failure("the test comes to its end", got, _location(element), _joined(notes))
    return None


def _first_failure(room: Element, sections: tuple[str, ...] = ()) -> Failure | None:
    """With the notes before it; the names of the sections around it are notes, too. Nobody looks deeper than a test of
    ours goes."""
    if len(sections) > _MAX_SECTIONS:
        return None
    notes = list(sections)
    for element in room:
        if element.tag in ("Info", "Warning"):
            notes.append(_note(_text(element)))
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


def _in_the_test(failure: Failure, case: Element) -> Failure:
    """A failure in a helper is looked for from the test on that called it."""
    if re.match(r"\w+_test\.cpp:", failure.location):
        return failure
    places = [_location(case), failure.location]
    return replace(failure, location=", fails in ".join(filter(None, places)))


def _outcome(case: Element) -> TestOutcome:
    overall = case.find("OverallResult")
    passed = overall is not None and overall.get("success") == "true"
    tags = tuple(re.findall(r"\[([^\[\]]+)\]", case.get("tags", "")))
    failure = None if passed else _first_failure(case)
    failure = failure if failure is None else _in_the_test(failure, case)
    return TestOutcome(printable(case.get("name", "")), passed, failure, tags)


_NO_XML = re.compile("[^\\t\\n\\r\\x20-\\ud7ff\\ue000-\\ufffd\\U00010000-\\U0010ffff]")


def _as_xml(report: bytes) -> bytes:
    """With something else for what no XML may hold. Catch2 writes an exception's words as they are, and some of them
    are no text: that must not hide how the test ended."""
    return _NO_XML.sub("\ufffd", report.decode("utf-8", "replace")).encode()


def parse_report(report: bytes) -> list[TestOutcome] | None:
    """The test cases of a complete report; None when the report is missing, cut short or not in order: it may be
    anything where the student's code runs in the process that writes it, as for a course's own step."""
    if len(report) > _MAX_BYTES or report.count(b"<") > _MAX_TAGS:
        return None
    try:
        return _outcomes(fromstring(_as_xml(report)))
    except Exception:  # a fault of this reader would show in the reference's report, which is read first
        return None


@dataclass(frozen=True)
class CutReport:
    """What a report tells that was cut short: the tests that had ended, and the one that ran, after so many seconds."""

    ended: list[TestOutcome]
    running: str
    after: float


def parse_cut_report(report: bytes) -> CutReport | None:
    """Of a program that was stopped; None where it tells no test that ran. Catch2 writes each test as it begins, and
    with `-d yes` the seconds of those that have ended."""
    if len(report) > _MAX_BYTES or report.count(b"<") > _MAX_TAGS:
        return None
    whole, end, rest = report.rpartition(_END_OF_A_TEST)
    beginning = _BEGINNING.search(rest if end else report)
    if beginning is None:
        return None
    try:
        first = _BEGINNING.search(whole)
        root = fromstring(_as_xml(b"<Catch>" + (whole[first.start() :] + end if first else b"") + b"</Catch>"))
        running = fromstring(_as_xml(beginning[0] + _END_OF_A_TEST)).get("name", "")
        ended = root.findall("TestCase")
        seconds = [float(one.get("durationInSeconds", "nan")) for one in root.findall("TestCase/OverallResult")]
    except Exception:  # cut in the middle of what is needed, or not in order
        return None
    if len(seconds) != len(ended):
        return None
    return CutReport([_outcome(case) for case in ended], printable(running), sum(seconds))


_END_OF_A_TEST = b"</TestCase>"
_BEGINNING = re.compile(rb'<TestCase (?:[^<>"]|"[^"<]*")*>')


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
