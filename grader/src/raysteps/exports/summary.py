"""A whole submission in a few lines of text."""

from collections.abc import Mapping, Sequence
from typing import Any

from raysteps.common.text import count, number
from raysteps.exports.items import items_of, step_text
from raysteps.exports.wording import one_line
from raysteps.kit.manifest import Step

Document = Mapping[str, Any]
_HOW_TO_REPEAT = "to repeat these random inputs, set RAYSTEPS_SEED="  # what a failed test of the kit says first


def title(result: Document, steps: Mapping[str, Step]) -> str:
    """`02 Intersection`, as the manifest has it."""
    step = steps.get(result["id"])
    name = step.title if step is not None else result["id"][3:]
    return f"{result['id'][:2]} {name}" + (" (bonus)" if result["bonus"] else "")


def total_line(document: Document) -> str:
    """`85.5 of 100 points, 5 of them bonus`."""
    total = document["total"]
    bonus = total["bonus"]["points"]
    of_them = f", {number(bonus)} of them bonus" if bonus else ""
    return f"{number(total['points'])} of {number(total['max'])} points{of_them}"


def _visible(result: Document) -> str:
    parts = []
    for key, noun in (("tests", "test"), ("images", "picture")):
        items: Sequence[Document] = result[key]
        if items:
            parts.append(f"{sum(item['passed'] for item in items)} of {count(len(items), noun)} passed")
    return ", ".join(parts) or str(result["status"])


def _failed_checks(result: Document, step: Step | None) -> list[str]:
    """What failed, and why."""
    failed = [(item, _why(item.text)) for item in items_of(result, step) if not item.passed]
    return [f"  - {item.kind} {item.name}: {one_line(why, 300)}" for item, why in failed]


def _why(text: str) -> str:
    """The first line that tells what is wrong; an expression alone does not, without what came of it."""
    lines = [line for line in text.splitlines() if not line.startswith(_HOW_TO_REPEAT)] or ["failed"]
    return ", ".join(lines[:2]) if lines[0].startswith("expected: ") else lines[0]


def _same_for_all(document: Document) -> str:
    """What is said of every step alike, such as that nothing could be read."""
    said = {step_text(result) for result in document["steps"]}
    return said.pop() if len(said) == 1 and len(document["steps"]) > 1 else ""


def summary(document: Document, steps: Mapping[str, Step], *, points: bool = True, checks: bool = False) -> str:
    """One line per step with what there is to say about it, on request with the checks that failed; without points,
    nothing that hidden checks decide."""
    lines = [f"{total_line(document)}."] if points else []
    same = _same_for_all(document)
    lines += same.splitlines()
    for result in document["steps"]:
        name = one_line(title(result, steps))
        if points:
            lines.append(f"{name}: {number(result['points'])} of {number(result['max'])}, {result['status']}")
        else:
            lines.append(f"{name}: {_visible(result)}")
        if not same and (points or result["status"] in ("not-started", "does-not-build")):
            lines += [f"  {line}" for line in step_text(result).splitlines()]
        if checks:
            lines += _failed_checks(result, steps.get(result["id"]))
    return "\n".join(lines)


def objects_tested(document: Document) -> float | None:
    """Step 06: surfaces tested per ray in percent of the scene's, over its pictures; None unless all are right."""
    images = [image for result in document["steps"] if result["id"][:2] == "06" for image in result["images"]]
    shares: list[float | None] = [image["share_tested"] for image in images if image["max_share"] is not None]
    known = [share for share in shares if share is not None]
    if not known or len(known) < len(shares) or not all(image["passed"] for image in images):
        return None
    return round(100 * sum(known) / len(known), 3)
