"""results.json of Gradescope."""

import html
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, get_args

from raysteps.common.text import clean
from raysteps.course.manifest import Step
from raysteps.exports.formats import ImageBudget, Paste
from raysteps.exports.items import (
    WHOLE,
    Item,
    ScoredItem,
    as_html,
    entries_of,
    extra_of,
    one_line,
    spread_deduction,
    summary,
    title,
)
from raysteps.report.wording import review_lines
from raysteps.results.model import Results, StepResult
from raysteps.results.work_ratio import NoWorkRatio, work_ratio_of

Visibility = Literal["visible", "hidden", "after_due_date", "after_published"]
VISIBILITIES: tuple[Visibility, ...] = get_args(Visibility)
_MAX_METADATA = 4 << 20
_MAX_PICTURES = 500_000  # bytes of all of them; Gradescope names no limit, and a page has to show them
_AROUND_A_PICTURE = 80


def _name(name: str, item: Item) -> str:
    return f"{name}: {item.name}" if item.kind == "step" else f"{name}: {item.kind} {item.name}"


def _test(name: str, number: str, entry: ScoredItem, hidden: Visibility) -> dict[str, Any]:
    item = entry.item
    test: dict[str, Any] = {
        "number": number,
        "name": _name(name, item),
        "score": entry.points,
        "max_score": entry.most,
        "status": "passed" if item.passed else "failed",
        "output": item.text,
        "visibility": "visible",
    }
    if item.kind == "hidden":
        test["visibility"] = hidden
        if hidden != "visible" and item.inputs:
            test["output"] = f"{item.text}\n{item.inputs}"
    return test


def _paste(test: dict[str, Any], item: Item) -> Paste:
    """The one kind of test whose output is HTML: what a program says is escaped in it."""

    def paste(label: str, uri: str) -> None:
        said = html.escape(label)
        test["output"] = f'{as_html(item.text)}<br><img alt="{said}" src="{uri}"><br>{said}'
        test["output_format"] = "html"

    return paste


def _tests(
    result: StepResult, steps: Mapping[str, Step], hidden: Visibility, album: ImageBudget
) -> list[dict[str, Any]]:
    tests = []
    number = int(result.id[:2])
    name = one_line(title(result, steps))
    for at, entry in enumerate(entries_of(result, steps.get(result.id)), 1):
        tests.append(_test(name, f"{number}.{at}", entry, hidden))
        album.offer(entry.item, _paste(tests[-1], entry.item))
    return tests


def _leaderboard(result: StepResult, steps: Mapping[str, Step]) -> list[dict[str, Any]]:
    """Work and memory of a step whose rays may test few objects only; nothing unless its pictures are all right."""
    step = steps.get(result.id)
    work_ratio = work_ratio_of(result, step.limited_pictures if step is not None else ())
    if isinstance(work_ratio, NoWorkRatio):
        return []
    name = one_line(title(result, steps))
    return [
        {"name": f"{name}: work (1 is the reference's)", "value": round(work_ratio.relative, 3), "order": "asc"},
        {"name": f"{name}: memory (kB)", "value": round(work_ratio.bytes / 1000, 1), "order": "asc"},
    ]


def _formats() -> dict[str, Any]:
    return {
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
    }


def to_gradescope(
    results: Results,
    steps: Mapping[str, Step],
    *,
    hidden: Visibility = "visible",
    names: Sequence[str] = (),
    folder: Path | None = None,
) -> dict[str, Any]:
    """Every check with its points, and its pictures where they are in the folder. With hidden checks out of sight,
    nothing visible tells the total."""
    output = summary(results, steps, points=hidden == "visible")
    if names:
        output = f"Submitted by {', '.join(names)}.\n{output}"
    results = spread_deduction(results)
    album = ImageBudget(_AROUND_A_PICTURE)
    tests = [test for result in results.steps for test in _tests(result, steps, hidden, album)]
    if extra := extra_of(results):
        text = clean("\n".join(review_lines(results.review, whole=True)))
        more = {"name": WHOLE, "score": extra, "max_score": 0, "status": "passed", "output": text}
        tests.append({**more, "visibility": "visible"})
    if folder is not None:
        album.fill(folder, _MAX_PICTURES)
    made: dict[str, object] = {
        "output": output,
        **_formats(),
        "execution_time": round(results.timing.seconds),
        "extra_data": {"kit": results.kit, "isolation": results.isolation.name},
        "tests": tests,
    }
    board = [entry for result in results.steps for entry in _leaderboard(result, steps)]
    return {**made, "leaderboard": board} if board else made


def not_graded(why: str) -> dict[str, Any]:
    """No score at all, so that Gradescope reports a failed run instead of a student's zero."""
    text = f"This submission was not graded: {clean(why)}\nIt has no score yet. Please tell your instructors."
    return {
        "output": text,
        **_formats(),
        "tests": [{"name": "The grader did not finish", "status": "failed", "output": text, "visibility": "visible"}],
    }


def submitters(path: Path) -> list[str]:
    """The names in submission_metadata.json; none when it says nothing that can be read."""
    try:
        if path.stat().st_size > _MAX_METADATA:
            return []
        users = json.loads(path.read_bytes())["users"]
        names = [user.get("name") or user.get("email") for user in users if isinstance(user, dict)]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return []
    return [one_line(name) for name in names if isinstance(name, str) and name.strip()]
