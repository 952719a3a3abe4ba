"""The last lines that an Autolab job prints."""

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from raysteps.common.text import clean
from raysteps.course.manifest import Step
from raysteps.exports.items import Item, entries_of, extra_of, objects_tested, spread_deduction
from raysteps.results.model import Results

_BRUTE_FORCE = 100.0  # per cent of the objects: what a ray tests without an octree


def _stage(items: Sequence[Item]) -> dict[str, Any]:
    stage: dict[str, Any] = {}
    for item in items:
        key = f"{item.kind} {item.name}"
        while key in stage:
            key += "'"
        stage[key] = {"passed": item.passed} if item.passed else {"passed": False, "hint": clean(item.text, 1000)}
    return stage


def to_autolab(results: Results, steps: Mapping[str, Step]) -> list[dict[str, Any]]:
    """What was checked, then the scores by problem; the ids of the steps are the problems' names."""
    results = spread_deduction(results)
    stages = {
        result.id: _stage([entry.item for entry in entries_of(result, steps.get(result.id))])
        for result in results.steps
    }
    tested = objects_tested(results)
    extra = extra_of(results)
    scores = {
        "scores": {result.id: result.points for result in results.steps} | ({"whole": extra} if extra else {}),
        "scoreboard": [results.total.points, _BRUTE_FORCE if tested is None else tested],
    }
    return [{"_presentation": "semantic", "stages": list(stages), **stages}, scores]


def no_scores(ids: Iterable[str]) -> str:
    """The last line after a fault: null is no score, while a line that cannot be read becomes a zero."""
    return json.dumps({"scores": dict.fromkeys(ids)})


def as_lines(document: Sequence[Mapping[str, Any]]) -> str:
    """One line each; Autolab reads the last two."""
    return "".join(json.dumps(part, ensure_ascii=False, allow_nan=False) + "\n" for part in document)
