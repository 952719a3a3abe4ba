"""What a function that is asked with many random numbers gives: directions, or samples of a path's way on."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from raysteps.judge.answers import no_number
from raysteps.judge.protocol import ProtocolError, TokenReader, Whole, f32, text, vector_words
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import Numbers, ratio_problem

_MAX = 40_000
_UNIT = 1e-4


def draws(draw: RandomSource, amount: int) -> dict[str, Whole]:
    """So many random points."""
    return {"seed": Whole(draw.whole(1, 1_000_000_000)), "times": Whole(amount)}


def read_directions(tokens: TokenReader) -> Numbers:
    """Row by row."""
    return tokens.rows(3, _MAX)


def _words_of(v: Sequence[float] | Numbers) -> str:
    """Of one direction or colour."""
    x, y, z = (float(value) for value in v)
    return vector_words((x, y, z))


def words_of_directions(directions: Numbers) -> str:
    """How many, and the first of them."""
    shown = ", ".join(_words_of(direction) for direction in directions[:4])
    return f"{len(directions)} directions, first {shown}"


@dataclass(frozen=True)
class Samples:
    """Each row: direction, weight, pdf, 1 where it is specular. `nothing`: so often nothing came."""

    nothing: int
    rows: Numbers

    @property
    def count(self) -> int:
        return len(self.rows) + self.nothing

    @property
    def directions(self) -> Numbers:
        return np.asarray(self.rows[:, :3])

    @property
    def weights(self) -> Numbers:
        return np.asarray(self.rows[:, 3:6])

    @property
    def pdfs(self) -> Numbers:
        return np.asarray(self.rows[:, 6])

    @property
    def are_specular(self) -> bool:
        return bool((self.rows[:, 7] == 1).all())

    @property
    def is_specular_somewhere(self) -> bool:
        return bool(self.rows[:, 7].any())


def read_sample(tokens: TokenReader) -> list[float] | None:
    """One row, or nothing."""
    if not tokens.flag():
        return None
    return [*tokens.vector(), *tokens.vector(), tokens.real(), float(tokens.flag())]


def read_samples(tokens: TokenReader) -> Samples:
    """All that follow."""
    there, rows = _optional_samples(tokens)
    return Samples(there.count(False), rows)


def read_samples_and_first(tokens: TokenReader) -> tuple[Samples, bool]:
    """All that follow but the last, and whether that is the first once more."""
    there, rows = _optional_samples(tokens)
    if not there:
        return Samples(0, rows), False
    same = there[0] == there[-1] and (not there[0] or bool((rows[0] == rows[-1]).all()))
    return Samples(there[:-1].count(False), rows[:-1] if there[-1] else rows), same


def _optional_samples(tokens: TokenReader) -> tuple[list[bool], Numbers]:
    """Which are there, and those."""
    there, rows = tokens.optional_rows(8, _MAX)
    if not np.isin(rows[:, 7], (0, 1)).all():
        raise ProtocolError("the answer holds another word where a flag belongs")
    return there, rows


def words_of_samples(samples: Samples) -> str:
    """How many, and the first of them."""
    shown = [f"nothing {samples.nothing} times"] if samples.nothing else []
    if len(samples.rows):
        row = samples.rows[0]
        shown.append(
            f"{len(samples.rows)} samples, first direction {_words_of(row[:3])} weight {_words_of(row[3:6])} "
            f"pdf {text(f32(float(row[6])))}{' specular' if row[7] else ''}"
        )
    return ", ".join(shown)


def odd_number(what: str, numbers: Numbers) -> str:
    """Whether one of them is infinite or NaN, in words."""
    return no_number(what, *numbers[~np.isfinite(numbers)].tolist())


def unit_problem(directions: Numbers) -> str:
    """Whether all are numbers, and of unit length."""
    odd = odd_number("a direction", directions)
    if odd:
        return odd
    lengths = np.linalg.norm(directions, axis=1)
    return "" if (np.abs(lengths - 1) <= _UNIT).all() else ratio_problem("a direction does not have length 1", lengths)
