"""results.json of a PrairieLearn external grader, and the question that is graded by it."""

import html
import uuid
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from raysteps.common.errors import UsageError
from raysteps.common.files import encoded, readable_json
from raysteps.common.text import clean, count, number, tenths
from raysteps.course.manifest import Step
from raysteps.exports.formats import ImageBudget, Paste
from raysteps.exports.items import (
    WHOLE,
    Kind,
    ScoredItem,
    entries_of,
    extra_of,
    one_line,
    spread_deduction,
    summary,
    title,
    wrapped,
)
from raysteps.report.wording import review_lines
from raysteps.results.model import Results, StepResult, Total

# The question.

SECONDS = 600  # PrairieLearn gives a job no more
_ENTRYPOINT = "/grade/serverFilesCourse/raysteps/run.sh"
_NAMESPACE = uuid.UUID("6f2b6c1e-52c5-4b0c-9a41-6d1d0b5f7a10")


def question_name(chosen: Sequence[str]) -> str:
    """Its folder: `raysteps`, or with the chosen steps `raysteps-02-04`."""
    return "-".join(["raysteps", *(step[:2] for step in chosen)])


def question_info(steps: Sequence[Step], chosen: Sequence[str], image: str) -> bytes:
    """info.json. Made again it has the same identifier, so that it stays the same question."""
    name = question_name(chosen)
    whole = steps[0].title if len(steps) == 1 else f"Ray tracer, {count(len(steps), 'step')}"
    words = [_ENTRYPOINT, *(["--steps", *chosen] if chosen else [])]
    info = {
        "uuid": str(uuid.uuid5(_NAMESPACE, f"{image} {name}")),
        "title": f"{steps[0].number} {whole}" if len(steps) == 1 else whole,
        "topic": "Ray tracing",
        "tags": ["code"],
        "type": "v3",
        "singleVariant": True,
        "gradingMethod": "External",
        "externalGradingOptions": {
            "image": image,
            "serverFilesCourse": ["raysteps/"],
            "entrypoint": words,
            "timeout": SECONDS,
        },
    }
    return readable_json(info).encode()


def question_page(steps: Sequence[Step]) -> bytes:
    """question.html. The list of files is one line, of which PrairieLearn reads the first only. Of several steps a
    student may hand in those that are begun."""
    names = [name for step in steps for name in step.files]
    if len(set(names)) < len(names) or any(set(name) & set(',/\\"') for name in names):
        raise UsageError(
            f"PrairieLearn tells the files of a question by their names alone, and {', '.join(names)} cannot be told "
            "apart by them; expected names without commas, all different, or other --steps"
        )
    attribute = "file-names" if len(steps) == 1 else "optional-file-names"
    said = "".join(f"    <li>{html.escape(f'{step.number} {step.title}')}: <code>{name}</code></li>\n"
                   for step in steps for name in step.files)  # fmt: skip
    text = f"""<pl-question-panel>
  <p>Hand in {"the file of the step" if len(steps) == 1 else "the files of all steps that you have begun"}:</p>
  <ul>
{said}  </ul>
  <pl-file-upload {attribute}="{", ".join(names)}"></pl-file-upload>
</pl-question-panel>
<pl-submission-panel>
  <pl-external-grader-results></pl-external-grader-results>
  <pl-file-preview></pl-file-preview>
</pl-submission-panel>
"""
    return text.encode()


# results.json. Messages are shown in lines as they are, and what is longer than a line has to be scrolled to.

MAX_BYTES = 1_000_000
_TEXT_LIMITS = (4000, 1000, 200, 60)
_ROOM_FOR_A_NOTE = 200
_AROUND_A_PICTURE = 40
_KINDS: Mapping[Kind, str] = {
    "test": "tests",
    "picture": "pictures",
    "hidden": "hidden cases",
    "together": "with the steps before it",
}


def score(total: Total) -> tuple[float, str]:
    """From 0 to 1, and a note where the bonus would lead above."""
    most = total.max or total.bonus.max
    share = total.points / most if most else 0.0
    note = "The bonus leads above 100 %, which PrairieLearn cannot hold: the score is 100 %." if share > 1 else ""
    return min(1.0, round(share, 6)), note


def _said(entry: ScoredItem, limit: int) -> str:
    """A check in its card: what it gave, and what is wrong."""
    item = entry.item
    points = f"{number(entry.points)} of {number(entry.most)} points"
    text = "" if item.passed else "".join(f"\n  {line}" for line in clean(item.text, limit).splitlines())
    name = item.name if item.kind == "step" else f"{item.kind} {item.name}"
    return f"{name}: {points}{text}"


def _card(name: str, entries: Sequence[ScoredItem], limit: int, *, bonus: bool) -> dict[str, Any]:
    """What PrairieLearn calls a test. A bonus adds to the points of the heading, but not to its maximum."""
    most = round(sum(entry.most for entry in entries), 2)
    lines = [_said(entry, limit) for entry in sorted(entries, key=lambda entry: entry.item.passed)]
    return {
        "name": f"{name}: at most {tenths(most)} points" if bonus else name,
        "points": round(sum(entry.points for entry in entries), 2),
        "max_points": 0 if bonus else most,
        "message": wrapped("\n".join(lines)),
    }


def _cards(result: StepResult, steps: Mapping[str, Step], *, alone: bool) -> list[tuple[str, list[ScoredItem]]]:
    """One for each step; for a step that is graded alone one for each kind of check."""
    entries = entries_of(result, steps.get(result.id))
    if not alone:
        return [(one_line(title(result, steps)), entries)]
    groups: dict[str, list[ScoredItem]] = {}
    for entry in entries:
        groups.setdefault(_KINDS.get(entry.item.kind, entry.item.name), []).append(entry)
    return list(groups.items())


def _without_pictures(results: Results, steps: Mapping[str, Step], limit: int) -> tuple[dict[str, Any], ImageBudget]:
    share, note = score(results.total)
    album, tests = ImageBudget(_AROUND_A_PICTURE), []
    for result in results.steps:
        bonus = result.bonus and bool(results.total.max)
        for name, entries in _cards(result, steps, alone=len(results.steps) == 1):
            card = _card(name, entries, limit, bonus=bonus)
            tests.append(card)
            for entry in entries:
                album.offer(entry.item, _paste(card))
    if extra := extra_of(results):
        said = wrapped(clean("\n".join(review_lines(results.review, whole=True)), limit))
        tests.append({"name": WHOLE, "points": extra, "max_points": 0, "message": said})
    text = clean("\n".join(filter(None, [note, summary(results, steps)])), 8 * limit)
    return {"gradable": True, "score": share, "message": wrapped(text), "tests": tests}, album


def _paste(card: dict[str, Any]) -> Paste:
    return lambda label, uri: card.setdefault("images", []).append({"label": label, "url": uri})


def to_prairielearn(results: Results, steps: Mapping[str, Step], folder: Path) -> dict[str, Any]:
    """Pictures are shrunk, then left out, until all is below the limit; the texts before that only if they must."""
    results = spread_deduction(results)
    for limit in _TEXT_LIMITS:
        made, album = _without_pictures(results, steps, limit)
        room = MAX_BYTES - len(encoded(made)) - _ROOM_FOR_A_NOTE
        if room > 0:
            break
    left_out = album.fill(folder, room)
    if left_out:
        were = "was" if left_out == 1 else "were"
        made["message"] += f"\n{count(left_out, 'picture')} did not fit and {were} left out."
    return made


def not_gradable(why: str) -> dict[str, Any]:
    """No score, and no attempt used up."""
    return {
        "gradable": False,
        "message": wrapped(f"The grader could not do its work: {clean(why)}"),
        "format_errors": ["This submission was not graded. No attempt was used up. Please tell your instructors."],
    }
