"""Which known mistakes are common in a class, step by step, and who made them."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

Document = Mapping[str, Any]


@dataclass(frozen=True)
class CommonMistake:
    """A mistake, and the places in the list of submissions of those who made it. Files of an older kit do not tell
    who, only how many."""

    number: int  # its place among all mistakes of the class
    step: str
    title: str
    submissions: int
    rows: Sequence[int]


def common_mistakes(document: Document) -> list[CommonMistake]:
    """The most common first, in the order of class.json."""
    rows: dict[tuple[str, str], list[int]] = defaultdict(list)
    for index, one in enumerate(document["submissions"]):
        for step, titles in one.get("mistakes", {}).items():
            for title in titles:
                rows[step, title].append(index)
    return [
        CommonMistake(
            index, found["step"], found["title"], found["submissions"], rows.get((found["step"], found["title"]), ())
        )
        for index, found in enumerate(document["mistakes"])
    ]
