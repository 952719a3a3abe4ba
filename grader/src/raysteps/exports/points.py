"""Shares a step's points out among its checks, in hundredths, so that the sums come out exactly."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from raysteps.common.text import clean
from raysteps.exports.items import Item, items_of, step_text
from raysteps.kit.manifest import Step


@dataclass(frozen=True)
class Entry:
    """A check with its points."""

    item: Item
    points: float
    most: float


def apportion(total: int, weights: Sequence[float]) -> list[int]:
    """Whole numbers that sum to the total, as near to the weights as can be: the largest remainders are rounded up."""
    whole = sum(weights)
    exact = [total * weight / whole for weight in weights]
    parts = [int(value) for value in exact]
    order = sorted(range(len(parts)), key=lambda index: parts[index] - exact[index])
    for index in order[: total - sum(parts)]:
        parts[index] += 1
    return parts


def _hundredths(points: float) -> int:
    return round(points * 100)


def _rest(result: Mapping[str, Any], items: list[Item], earned: int, lost: int) -> list[Item]:
    """One more entry for what no check accounts for: a step that was not run, claims that were not confirmed."""
    all_wrong = earned > 0 and not sum(item.weight * item.share for item in items)
    all_right = lost > 0 and not sum(item.weight * (1 - item.share) for item in items)
    if items and not all_wrong and not all_right:
        return []
    share = earned / (earned + lost) if earned + lost else 0.0
    if not items:
        return [Item("step", str(result["status"]), 1.0, share, step_text(result))]
    if all_wrong != all_right:
        share = 1.0 if all_wrong else 0.0
    claims = [clean(claim) for claim in result["inconsistent"]]
    return [Item("step", "the rest", 1.0, share, "\n".join(["Points that no single check accounts for.", *claims]))]


def entries_of(result: Mapping[str, Any], step: Step | None) -> list[Entry]:
    """What was earned goes to the checks by what was right in them, what was lost by what was wrong."""
    earned = _hundredths(result["points"])
    lost = max(0, _hundredths(result["max"]) - earned)
    items = items_of(result, step)
    items += _rest(result, items, earned, lost)
    right = [item.weight * item.share for item in items]
    wrong = [item.weight * (1 - item.share) for item in items]
    gains = apportion(earned, right) if earned else [0] * len(items)
    losses = apportion(lost, wrong) if lost else [0] * len(items)
    return [Entry(item, gain / 100, (gain + loss) / 100) for item, gain, loss in zip(items, gains, losses, strict=True)]
