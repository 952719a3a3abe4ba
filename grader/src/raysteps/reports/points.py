"""How the points of a step come about."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from raysteps.common.text import count
from raysteps.kit.manifest import Step
from raysteps.reports.words import percent

_NEAR = 0.011  # points: a step's are rounded once, its parts each by itself


@dataclass(frozen=True)
class Part:
    """One of the four things that earn points."""

    name: str
    said: str  # how much of it was right
    share: float
    percent: float  # of the step's points that it is worth
    most: float
    earned: float


def _right(items: Sequence[Mapping[str, Any]], noun: str) -> tuple[str, float]:
    right = sum(bool(item["passed"]) for item in items)
    return (f"{right} of {count(len(items), noun)}", right / len(items)) if items else ("not run", 0.0)


def _hidden(items: Sequence[Mapping[str, Any]]) -> tuple[str, float]:
    weight = sum(item["weight"] for item in items)
    share = sum(item["share"] * item["weight"] for item in items) / weight if weight else 0.0
    if not items:
        return "not run", 0.0
    return percent(share), share


def parts_of(result: Mapping[str, Any], step: Step | None) -> list[Part]:
    """Tests, pictures, hidden and together; without the hidden part where the kit cannot judge it. Nothing when the
    step's weights are not known."""
    if step is None:
        return []
    together = bool(result["cumulative"]["passed"])
    found = [
        ("tests", _right(result["tests"], "test"), step.weight_tests),
        ("pictures", _right(result["images"], "picture"), step.weight_images),
        ("hidden", _hidden(result["hidden"]), step.weight_hidden),
        ("together", ("yes" if together else "no", float(together)), step.weight_together),
    ]
    if result["max"] < step.points - _NEAR:
        found = [part for part in found if part[0] != "hidden"]
    return [
        Part(name, said, share, weight * 100, step.points * weight, step.points * weight * share)
        for name, (said, share), weight in found
        if weight > 0
    ]


def rest_of(result: Mapping[str, Any], parts: Sequence[Part]) -> float:
    """Points that the parts do not account for, as when an older kit weighed them otherwise."""
    rest = result["points"] - sum(part.earned for part in parts)
    return round(float(rest), 2) if parts and abs(rest) > _NEAR else 0.0
