"""The same ray in two records."""

from dataclasses import dataclass
from typing import NamedTuple

from raysteps.commands.inspect.values import CLOSE, Record, Vector, brief, length, same_direction, same_number

EYE = "eye"


class Difference(NamedTuple):
    """`place` is the key of a line of the tree; `function` is empty where no step's function is to blame."""

    place: tuple[str, ...]
    words: str
    function: str
    why: str = ""
    shaky: bool = False  # the two rays began a little apart already, so that an edge may lie between them


@dataclass(frozen=True)
class Pair:
    """The same ray in both records, `place` being its line in the tree."""

    mine: Record
    reference: Record
    place: tuple[str, ...]
    name: str
    close: float
    step: int
    accel: str
    lights: list[Record]

    def at(self, item: str, words: str, function: str, why: str = "") -> Difference:
        plain = self.place == (EYE,) and not words.startswith("yours")  # what else happens at the eye ray needs no name
        return Difference((*self.place, item), words if plain else f"{self.name}: {words}", function, why, self.shaky)

    @property
    def shaky(self) -> bool:
        return self.close > 2 * CLOSE


def surface_name(hit: Record) -> str:
    return "something that is no surface" if hit["surface"] is None else f"surface {hit['surface']} ({hit['kind']})"


def not_unit(direction: Vector) -> str:
    """Says so of a direction whose length is not 1."""
    size = length(direction)
    return "" if abs(size - 1) < 1e-3 else f"its length is {size:.4g} and not 1"


def meets(hit: Record | None) -> str:
    return "meets nothing" if hit is None else f"meets {surface_name(hit)} at distance {brief(hit['distance'])}"


def same_meeting(one: Record | None, other: Record | None, close: float) -> bool:
    """Two surfaces at the same distance are the same where they look the same."""
    if one is None or other is None:
        return one is other
    alike = one["surface"] == other["surface"] or (
        one["fill"] == other["fill"] and same_direction(one["normal"], other["normal"], close)
    )
    return alike and same_number(one["distance"], other["distance"], close, 1e-5)
