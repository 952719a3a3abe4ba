"""Classroom 50's result.json, and the output of the older GitHub Classroom's autograding steps."""

import base64
import json
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

from raysteps.common.errors import UsageError
from raysteps.common.text import apportion, clean
from raysteps.course.manifest import Step
from raysteps.exports.items import harmless_log, one_line, step_text, title
from raysteps.results.model import Results

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


def _instant(when: datetime) -> str:
    return when.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def to_classroom50(
    results: Results, steps: Mapping[str, Step], environment: Mapping[str, str], submitted: datetime
) -> dict[str, Any]:
    """One test per step; who and what come from the environment that the runner sets."""
    missing = [name for name in _FIELDS.values() if not environment.get(name)]
    if missing:
        raise UsageError(f"these variables are not set: {', '.join(missing)}; Classroom 50's runner sets them")
    pairs = whole_points(results)
    result: dict[str, Any] = {"schema": "classroom50/result/v1"}
    result |= {field: environment[name] for field, name in _FIELDS.items()}
    result["review"] = environment.get("REVIEW_URL") or environment["COMMIT_URL"]
    if environment.get("ASSIGNMENT_TYPE"):
        result["assignment_type"] = environment["ASSIGNMENT_TYPE"]
    if environment.get("OWNER") or environment.get("USERNAME"):
        result["owner"] = environment.get("OWNER") or environment["USERNAME"]
    result["datetime"] = _instant(submitted)
    result["score"] = sum(points for points, _ in pairs)
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
    return result


def to_legacy(results: Results, steps: Mapping[str, Step]) -> dict[str, Any]:
    """One test per step; its seconds are those of its pictures and hidden cases."""
    tests = []
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
    passed = all(step.status == "passed" for step in results.steps if not step.bonus)
    most = sum(most for _, most in pairs)
    return {"version": 1, "status": "pass" if passed else "fail", "max_score": most, "tests": tests}


def output_line(legacy: Mapping[str, Any]) -> str:
    """What is appended to the file that $GITHUB_OUTPUT names."""
    return "result=" + base64.b64encode(json.dumps(legacy).encode()).decode("ascii") + "\n"
