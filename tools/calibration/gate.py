"""Where the limit of a picture belongs: midway between the worst correct solution and the mildest mistake."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal

LEAST_MARGIN = 2.0
_LEAST_WRONG = 2.0  # pixels: so many may differ in a correct solution of which nobody has thought
_HANDFUL = 10.0  # pixels: a mistake that changes no more of a picture is not what the picture shows
_NOISE = 1.5  # factor by which other processors and compilers may move a limit


@dataclass(frozen=True)
class Share:
    """A share of wrong pixels, and whose it is."""

    value: float
    whose: str


@dataclass(frozen=True)
class Gate:
    """What one picture can tell apart. `unseen` are mistakes that it hardly shows."""

    worst: Share
    mildest: Share | None
    unseen: tuple[str, ...]
    limit: float
    written: float

    @property
    def margin(self) -> float:
        """How many times worse the mildest mistake is than the worst correct solution."""
        return math.inf if self.mildest is None else self.mildest.value / self.worst.value

    @property
    def is_clear(self) -> bool:
        return self.margin >= LEAST_MARGIN

    @property
    def is_written(self) -> bool:
        """Whether the manifest says so, but for what differs from machine to machine."""
        apart = self.worst.value < self.written and (self.mildest is None or self.written < self.mildest.value)
        return apart and self.limit / _NOISE <= self.written <= self.limit * _NOISE

    @property
    def stands(self) -> float:
        """The limit that is in the manifest once it is written: one that is near enough stays."""
        return self.written if self.is_written else self.limit


def rounded(value: float) -> float:
    """To two digits that count."""
    return float(f"{value:.1e}")


def plain(value: float) -> str:
    """Without an exponent, as a manifest has it."""
    return f"{Decimal(repr(value)):f}"


def gate_between(
    correct: Mapping[str, float], mistakes: Mapping[str, Sequence[float]], pixels: int, written: float
) -> Gate:
    """`correct`: the worst share of each; `mistakes`: one share for each seed, of which the least counts."""
    whose = max(correct, key=lambda name: correct[name])
    worst = Share(max(correct[whose], _LEAST_WRONG / pixels), whose if correct[whose] else "")
    least = {name: min(shares) for name, shares in mistakes.items()}
    seen = {name: share for name, share in least.items() if share > max(worst.value, _HANDFUL / pixels)}
    unseen = tuple(name for name in least if name not in seen)
    if not seen:
        return Gate(worst, None, unseen, written if written > worst.value else rounded(4 * worst.value), written)
    mildest = min(seen, key=lambda name: seen[name])
    limit = rounded(math.sqrt(worst.value * seen[mildest]))
    return Gate(worst, Share(seen[mildest], mildest), unseen, limit, written)
