"""How an instructor wants a submission to be graded."""

import copy
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

# How much a student is told about the hidden part.

Feedback = Literal["full", "diagnosis", "score"]

_CASES = ("given", "expected", "actual", "case")
_HIDDEN_ITEM = "hidden item"  # of the line that counts them


def _without_cases(item: dict[str, Any]) -> dict[str, Any]:
    """A picture's message tells of single pixels."""
    places = {"message": ""} if item["kind"] == "picture" and item["outcome"] == "wrong" else {}
    return {**item, **dict.fromkeys(_CASES, ""), **places}


def _share_only(items: list[dict[str, Any]], kind: str, name: str) -> list[dict[str, Any]]:
    """All items of a kind as one, that says nothing but how much was earned."""
    mine = [item for item in items if item["kind"] == kind]
    weight = sum(item["weight"] for item in mine)
    if not mine or weight <= 0:
        return []
    share = sum(item["share"] * item["weight"] for item in mine) / weight
    whole = all(item["share"] >= 1 for item in mine)
    return [
        {
            **_without_cases(mine[0]),
            "name": name,
            "share": 1.0 if whole else min(round(share, 6), 0.999999),
            "weight": round(weight, 6),
            "wrong_share": None,
            "groups": [],
            "message": "",
            "seconds": round(sum(item["seconds"] for item in mine), 3),
            "outcome": "ok" if whole else "wrong",
        }
    ]


def _withheld_step(step: dict[str, Any], feedback: Feedback) -> dict[str, Any]:
    hidden = step["hidden"]
    step = {**step, "inconsistent": []}  # that is for the instructor
    if feedback == "diagnosis":
        return {**step, "hidden": [_without_cases(item) for item in hidden]}
    texts = {item["message"] for item in hidden if item["message"]}
    return {
        **step,
        "diagnoses": [],
        "hidden": _share_only(hidden, "function", "hidden cases") + _share_only(hidden, "picture", "hidden pictures"),
        "messages": [line for line in step["messages"] if line not in texts and _HIDDEN_ITEM not in line],
    }


def withhold(document: dict[str, Any], feedback: Feedback) -> dict[str, Any]:
    """A results.json document for the student: `full` as it is; `diagnosis` without the cases themselves; `score`
    with nothing of the hidden part but its shares. The points stay the same."""
    document = copy.deepcopy(document)
    if feedback != "full":
        document["steps"] = [_withheld_step(step, feedback) for step in document["steps"]]
        document["seed"] = None  # whoever has it can make the cases
    return document


@dataclass(frozen=True)
class Settings:
    """Together with the kit and the submission this fixes a grade."""

    seed: int = 1
    only: tuple[str, ...] = ()  # step ids; all steps when there are none
    feedback: Feedback = "full"
    limits: Mapping[str, float] = field(default_factory=dict)  # changes by name, see programs.limits
    jobs: int = 1  # steps at a time; changes a grade only where a step is near its time limit
