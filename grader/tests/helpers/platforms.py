"""How each system reads what an export leaves, written anew from what the system says of itself. Each reader returns
what a student, or the gradebook, would see."""

import base64
import binascii
import csv
import io
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any


@dataclass
class Shown:
    """`points` is None where nothing is entered for the student."""

    points: float | None
    most: float | None = None
    text: str = ""
    pictures: int = 0
    tests: list[Any] = field(default_factory=list)


def _numbers(values: Sequence[Any]) -> bool:
    return all(isinstance(value, int | float) and not isinstance(value, bool) and value >= 0 for value in values)


_GRADESCOPE_FORMATS = {"text", "html", "simple_format", "md", "ansi"}


def gradescope(root: Path) -> Shown:
    """Autograder Specifications (gradescope-autograders.readthedocs.io/en/latest/specs): results.json has a score, or
    each of its tests has one; with neither the run is reported as failed."""
    results = json.loads((root / "results" / "results.json").read_text(encoding="utf-8"))
    tests = results.get("tests", [])
    usual = results.get("test_output_format", "text")
    assert {test.get("output_format", usual) for test in tests} | {results.get("output_format", "text")} <= (
        _GRADESCOPE_FORMATS
    )
    scores = [test["score"] for test in tests if "score" in test]
    points = results.get("score", round(sum(scores), 6) if scores and len(scores) == len(tests) else None)
    assert _numbers([*scores, *([] if points is None else [points])])
    html = [test["output"] for test in tests if test.get("output_format", usual) == "html"]
    for output in html:  # a browser reads it
        assert {tag.split()[0] for tag in re.findall("<[^>]*>", output)} <= {"<br>", "<img"}
    said = [results.get("output", ""), *(f"{test['name']}\n{test.get('output', '')}" for test in tests)]
    most = sum(test.get("max_score", 0) for test in tests)
    pictures = sum(output.count('src="data:image/png;base64,') for output in html)
    return Shown(points, round(most, 6) or None, "\n".join(said), pictures, tests)


_IDENTITY = {"classroom": "CLASSROOM", "assignment": "ASSIGNMENT", "submission": "SUBMISSION_TAG"}
_ASSET = re.compile(r"[A-Za-z0-9_-](?:[A-Za-z0-9._-]{0,253}[A-Za-z0-9_-])?")


def classroom50(checkout: Path, code: int, environment: Mapping[str, str]) -> Shown:
    """Advanced Autograding in the wiki of foundation50/classroom50, and its runner: another exit code than 0 is an
    error, recorded without tests and with 0 of 0 points; else result.json is checked field by field, and
    release-body.md and the files that the assignment names are published."""
    if code != 0:
        return Shown(None, 0, f"autograder exited {code}")
    result = json.loads((checkout / "result.json").read_text(encoding="utf-8"))
    assert result["schema"] == "classroom50/result/v1"
    assert all(result[key] == environment[name] for key, name in _IDENTITY.items())
    assert result["submission"].startswith("submit/")
    assert all(isinstance(result[key], str) and result[key] for key in ("commit", "release", "review", "datetime"))
    for one in (result, *result["tests"]):
        assert type(one["score"]) is int
        assert type(one["max-score"]) is int
        assert 0 <= one["score"] <= one["max-score"]
    for test in result["tests"]:
        assert isinstance(test["test-name"], str)
        assert test["test-name"]
        assert type(test["passed"]) is bool
    paths = json.loads(environment["RELEASE_ASSETS"])
    assert len(paths) <= 50
    assert sum(len(path.encode()) for path in paths) <= 8192
    names = [path.rpartition("/")[2] for path in paths]
    assert len(set(names)) == len(names)
    assert all(_ASSET.fullmatch(name) and ".." not in name for name in names)
    published = [checkout / path for path in paths if (checkout / path).is_file()]
    assert not any(path.is_symlink() or path.parent.is_symlink() for path in published)
    assert sum(path.stat().st_size for path in published) <= 100 << 20
    body = (checkout / "release-body.md").read_text(encoding="utf-8")
    assert len(body) <= 125_000, "GitHub takes no longer text"
    return Shown(result["score"], result["max-score"], body, len(published), result["tests"])


def legacy(output: Path, code: int) -> Shown:
    """The autograding steps of GitHub Classroom (classroom-resources/autograding-grading-reporter): each leaves its
    result as base64 of JSON; without one the reporter has nothing to report."""
    text = output.read_text(encoding="utf-8") if output.is_file() else ""
    found = re.fullmatch(r"result=([A-Za-z0-9+/]+=*)\n", text)
    if code != 0 or found is None:
        return Shown(None)
    try:
        result = json.loads(base64.b64decode(found[1], validate=True))
    except binascii.Error as error:
        raise AssertionError("not base64") from error
    assert result["version"] == 1
    assert result["status"] in ("pass", "fail", "error")
    assert sum(test["score"] for test in result["tests"]) <= result["max_score"]
    said = "\n".join(f"{test['name']}: {test['message']}" for test in result["tests"])
    return Shown(sum(test["score"] for test in result["tests"]), result["max_score"], said, tests=result["tests"])


def autolab(output: str, problems: Mapping[str, float], *, hooks: bool) -> tuple[Shown, dict[str, float | None]]:
    """Guide for Lab Authors, Formatted Feedback and Lab Hooks in autolab/Autolab, and its saveAutograde: the last line
    is JSON with scores by problem; where it cannot be read or names no problem, each new score is a zero that is
    released. `hooks`: with the functions of hooks.rb."""
    lines = output.rstrip().splitlines()
    zero: dict[str, float | None] = dict.fromkeys(problems, 0.0)
    try:
        parsed = json.loads(re.sub(r"([a-zA-Z0-9]+):", r'"\1":', lines[-1]))
        scores: dict[str, float | None] = parsed["scores"]
        entered = scores if scores else zero
    except (ValueError, KeyError, TypeError, IndexError):
        entered = {} if hooks else zero
    if hooks:
        entered = {name: score for name, score in entered.items() if score is not None}
    assert set(entered) <= set(problems), "a problem that is not there makes all of them zeros"
    known = [score for score in entered.values() if score is not None]
    assert _numbers(known)
    try:
        before = json.loads(lines[-2])
    except (ValueError, IndexError):
        before = {}
    stages = before.get("stages", []) if isinstance(before, dict) and before.get("_presentation") == "semantic" else []
    tests = [(stage, name, test) for stage in stages for name, test in before[stage].items() if name[0] != "_"]
    assert all(isinstance(test["passed"], bool) for _, _, test in tests)
    return Shown(sum(known) if known else None, sum(problems.values()), output, tests=tests), entered


def prairielearn(root: Path, code: int) -> Shown:
    """External Grading and pl-external-grader-results in the documents of PrairieLearn, and its grader host: results
    are read if the entry point ends with 0, and may have 1 MiB; where they are not gradable no points are given and no
    attempt is used up. The heading shows the sums of the tests' points."""
    if code != 0:
        return Shown(None, text="Unknown error; please contact course staff.")
    data = (root / "results" / "results.json").read_bytes()
    assert len(data) <= 1 << 20
    results = json.loads(data)
    if not results.get("gradable", True):
        errors = results.get("format_errors", [])
        return Shown(
            None, text="\n".join([results.get("message", ""), *([errors] if isinstance(errors, str) else errors)])
        )
    assert 0 <= results["score"] <= 1
    tests = results["tests"]
    assert _numbers([test[key] for test in tests for key in ("points", "max_points")])
    pictures = [image for test in tests for image in test.get("images", [])]
    assert all(image["url"].startswith("data:image/png;base64,") for image in pictures)
    points, most = (round(sum(test[key] for test in tests), 2) for key in ("points", "max_points"))
    assert results["score"] == min(1.0, round(points / most, 6)), "the heading and the score say the same"
    said = "\n".join([results["message"], *(f"{test['name']}\n{test['message']}" for test in tests)])
    return Shown(points, most, said, len(pictures), tests)


def gradebook(text: str, heading: str, key: str, row: str, feedback: str = "") -> Shown:
    """A cell of a Canvas gradebook or a Moodle worksheet: an empty one leaves what there is."""
    rows = list(csv.reader(io.StringIO(text.removeprefix("\ufeff"))))
    at = {name: index for index, name in enumerate(rows[0])}
    mine = next(cells for cells in rows if len(cells) > at[key] and cells[at[key]] == row)
    assert not any(cell.startswith(("=", "@", "\t")) for cell in mine), "a spreadsheet would take it for a formula"
    grade = mine[at[heading]]
    return Shown(float(grade) if grade else None, text=mine[at[feedback]] if feedback else "")
