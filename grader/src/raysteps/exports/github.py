"""Classroom 50's result.json with what it publishes beside it, and the output of the older GitHub Classroom."""

import base64
import json
from collections.abc import Collection, Iterable, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from raysteps.common.errors import UsageError
from raysteps.common.text import apportion, clean, harmless_log, tenths
from raysteps.course.manifest import Step
from raysteps.exports.formats import contact_sheet
from raysteps.exports.items import (
    WHOLE,
    as_code,
    extra_of,
    failed_checks,
    items_of,
    one_line,
    spread_deduction,
    step_text,
    title,
)
from raysteps.grading.withhold import withhold
from raysteps.report.student import student_page
from raysteps.report.wording import review_lines, total_words
from raysteps.results.model import Results, StepResult
from raysteps.results.store import REPORT

_FIELDS = {
    "classroom": "CLASSROOM",
    "assignment": "ASSIGNMENT",
    "submission": "SUBMISSION_TAG",
    "commit": "COMMIT_URL",
    "release": "RELEASE_URL",
}


def whole_points(results: Results) -> list[tuple[int, int]]:
    """Each step's points and maximum as whole numbers. The sums are the rounded sums; no step exceeds its most."""
    most = [round(result.max * 100) for result in results.steps]
    points = [min(round(result.points * 100), cap) for result, cap in zip(results.steps, most, strict=True)]
    caps = apportion((sum(most) + 50) // 100, most) if sum(most) else [0] * len(most)
    earned = apportion((sum(points) + 50) // 100, points) if sum(points) else [0] * len(points)
    return [(min(have, cap), cap) for have, cap in zip(earned, caps, strict=True)]


def _whole_test(results: Results, pairs: Sequence[tuple[int, int]]) -> tuple[int, str] | None:
    """What the total has beyond the steps, as a person added it, and why."""
    extra = max(0, (round(results.total.points * 100) + 50) // 100 - sum(points for points, _ in pairs))
    if extra_of(results) <= 0 or not extra:
        return None
    return extra, harmless_log(clean("\n".join(review_lines(results.review, whole=True))))


def _instant(when: datetime) -> str:
    return when.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def to_classroom50(
    results: Results, steps: Mapping[str, Step], environment: Mapping[str, str], submitted: datetime
) -> dict[str, Any]:
    """One test per step; who and what come from the environment that the runner sets."""
    missing = [name for name in _FIELDS.values() if not environment.get(name)]
    if missing:
        raise UsageError(f"these variables are not set: {', '.join(missing)}; Classroom 50's runner sets them")
    results = spread_deduction(results)
    pairs = whole_points(results)
    whole = _whole_test(results, pairs)
    result: dict[str, Any] = {"schema": "classroom50/result/v1"}
    result |= {field: environment[name] for field, name in _FIELDS.items()}
    result["review"] = environment.get("REVIEW_URL") or environment["COMMIT_URL"]
    if environment.get("ASSIGNMENT_TYPE"):
        result["assignment_type"] = environment["ASSIGNMENT_TYPE"]
    if environment.get("OWNER") or environment.get("USERNAME"):
        result["owner"] = environment.get("OWNER") or environment["USERNAME"]
    result["datetime"] = _instant(submitted)
    result["score"] = sum(points for points, _ in pairs) + (whole[0] if whole else 0)
    result["max-score"] = sum(most for _, most in pairs)
    result["tests"] = [
        {
            "test-name": one_line(title(step, steps)),
            "passed": step.status == "passed",
            "score": points,
            "max-score": most,
            "message": harmless_log(step_text(step)),
        }
        for step, (points, most) in zip(results.steps, pairs, strict=True)
    ]
    if whole:
        result["tests"].append(
            {"test-name": WHOLE, "passed": True, "score": whole[0], "max-score": 0, "message": whole[1]}
        )
    return result


# What Classroom 50 publishes beside the points: the text of the release, and files that the assignment names.

BODY = "release-body.md"
FOLDER = "raysteps-report"  # of the files, in the folder of result.json
_MAX_BODY = 100_000  # characters; GitHub takes 125,000
_TEXT = 8_000  # of each step


def release_assets(steps: Iterable[str]) -> list[str]:
    """For the assignment's `release_assets`: the report, and for each step a picture that holds all of its pictures."""
    return [f"{FOLDER}/{name}" for name in (REPORT, *(f"{step}.png" for step in steps))]


def release_files(results: Results, steps: Mapping[str, Step], folder: Path) -> dict[str, bytes]:
    """By their place below the folder of result.json. Hidden cases are not in them: the release is the student's."""
    shown = withhold(results, "diagnosis")
    page = _page(shown, steps, folder)
    files = {} if page is None else {f"{FOLDER}/{REPORT}": page}
    for result in shown.steps:
        pictures = contact_sheet(folder, items_of(result, steps.get(result.id)))
        if pictures is not None:
            files[f"{FOLDER}/{result.id}.png"] = pictures
    return files


def _page(results: Results, steps: Mapping[str, Step], folder: Path) -> bytes | None:
    try:
        return student_page(results, folder, list(steps.values())).encode()
    except Exception as error:  # a page is not worth a grade
        print(f"raysteps: no {REPORT}: {harmless_log(clean(repr(error)))}", flush=True)
        return None


def _links(files: Collection[str], environment: Mapping[str, str]) -> dict[str, str]:
    """Where the files will lie, by their place: those that the assignment names."""
    try:
        listed = json.loads(environment.get("RELEASE_ASSETS") or "[]")
    except ValueError:
        return {}
    base = environment.get("RELEASE_URL", "")
    if "/releases/tag/" not in base or not isinstance(listed, list):
        return {}
    base = base.replace("/releases/tag/", "/releases/download/", 1)
    return {file: f"{base}/{file.rpartition('/')[2]}" for file in files if file in listed}


def _section(result: StepResult, steps: Mapping[str, Step], picture: str | None) -> list[str]:
    """What is wrong with a step, as a block of code: Markdown and HTML in it are only text."""
    said = [step_text(result), *failed_checks(result, steps.get(result.id))]
    name = one_line(title(result, steps))
    lines = [f"#### {_inline(name)}", "", as_code("\n".join(filter(None, said)) or result.shown.words, _TEXT)]
    return [*lines, f"[![The pictures of step {result.id[:2]}]({picture})]({picture})", ""] if picture else lines


def _inline(text: str) -> str:
    """In the middle of Markdown."""
    return "".join(f"\\{letter}" if letter in "\\`*_{}[]()<>#+-!|~@&:" else letter for letter in text)


def release_body(
    results: Results, steps: Mapping[str, Step], files: Collection[str], environment: Mapping[str, str]
) -> str:
    """The points, what is wrong with each step, and links to the files that are published."""
    links = _links(files, environment)
    lines = [f"### {total_words(results.total)}", "", "| step | | points |", "|---|---|---|"]
    for result in results.steps:
        name = _inline(one_line(title(result, steps)))
        lines.append(f"| {name} | {result.shown.words} | {tenths(result.points)} of {tenths(result.max)} |")
    results = spread_deduction(results)
    pairs = whole_points(results)
    whole = _whole_test(results, pairs)
    recorded = f"{sum(points for points, _ in pairs) + (whole[0] if whole else 0)} of {sum(most for _, most in pairs)}"
    lines += ["", f"Recorded in whole numbers, bonus included: {recorded}.", ""]
    report = links.get(f"{FOLDER}/{REPORT}")
    lines += [f"[The report with all pictures]({report}): download it and open it in a browser.", ""] if report else []
    lines += [as_code("\n".join(said), _TEXT)] if (said := review_lines(results.review, whole=True)) else []
    for result in results.steps:
        if result.status != "passed" or result.review:
            lines += _section(result, steps, links.get(f"{FOLDER}/{result.id}.png"))
    text = "\n".join(lines)
    if len(text) <= _MAX_BODY:
        return text
    return "\n".join(lines[: 4 + len(results.steps)]) + "\n\nThere is more to say than fits here; see the report.\n"


def to_legacy(results: Results, steps: Mapping[str, Step]) -> dict[str, Any]:
    """One test per step; its seconds are those of its pictures and hidden cases."""
    tests = []
    results = spread_deduction(results)
    pairs = whole_points(results)
    for step, (points, _) in zip(results.steps, pairs, strict=True):
        seconds = sum(image.seconds for image in step.images) + sum(item.seconds for item in step.hidden)
        known = steps.get(step.id)
        tests.append(
            {
                "name": one_line(title(step, steps)),
                "status": "pass" if step.status == "passed" else "fail",
                "score": points,
                "message": harmless_log(clean(step_text(step))),
                "test_code": f"./raysteps check {step.id[:2]}",
                "filename": f"steps/{known.path.as_posix()}" if known is not None else "",
                "line_no": 0,
                "execution_time": f"{seconds:.1f}s",
            }
        )
    if whole := _whole_test(results, pairs):
        tests.append(
            {
                "name": WHOLE,
                "status": "pass",
                "score": whole[0],
                "message": whole[1],
                "test_code": "",
                "filename": "",
                "line_no": 0,
                "execution_time": "0.0s",
            }
        )
    passed = all(step.status == "passed" for step in results.steps if not step.bonus)
    most = sum(most for _, most in pairs)
    return {"version": 1, "status": "pass" if passed else "fail", "max_score": most, "tests": tests}


def output_line(legacy: Mapping[str, Any]) -> str:
    """What is appended to the file that $GITHUB_OUTPUT names."""
    return "result=" + base64.b64encode(json.dumps(legacy).encode()).decode("ascii") + "\n"
