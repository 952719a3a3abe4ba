"""What a benchmark leaves behind: JSON in build/bench."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from rich.console import Console
from rich.markup import escape

from raysteps.common.documents import Malformed, convert, parse, plain
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_json
from raysteps.course.project import Project
from tools.bench.model import Numbers

T = TypeVar("T", bound=Numbers)


def _checked(document: Numbers) -> Numbers:
    try:
        return convert(plain(document), type(document))
    except Malformed as error:
        raise GraderFault(f"not what `bench {document.name}` writes: {error}") from error


def place_of(project: Project, name: str) -> Path:
    """Where `bench NAME` puts its numbers."""
    return project.build / "bench" / f"{name}.json"


def keep(project: Project, document: Numbers, console: Console) -> None:
    """Writes build/bench/NAME.json and tells so."""
    path = place_of(project, document.name)
    write_json(path, plain(_checked(document)))
    console.print(f"Numbers: {escape(str(path))}", soft_wrap=True)


def kept(project: Project, kind: type[T]) -> T | None:
    """What was measured last; nothing when it never was."""
    path = place_of(project, kind.name)
    if not path.is_file():
        return None
    try:
        return parse(path.read_bytes(), kind, complete=True)
    except Malformed as error:
        again = f"measure again: ./raysteps bench {kind.name}"
        raise UsageError(f"{path}: not what `bench {kind.name}` writes: {error}; {again}") from error


# Means and slopes.


def geometric_mean(values: Sequence[float]) -> float:
    """Of numbers above 0."""
    return math.exp(math.fsum(math.log(value) for value in values) / len(values))


@dataclass(frozen=True)
class Growth:
    """How y grows with x: about x to the power of `exponent`, and by `per_doubling` with each doubling of x."""

    exponent: float
    per_doubling: float


def _slope(xs: Sequence[float], ys: Sequence[float]) -> float:
    middle_x, middle_y = math.fsum(xs) / len(xs), math.fsum(ys) / len(ys)
    spread = math.fsum((x - middle_x) ** 2 for x in xs)
    return math.fsum((x - middle_x) * (y - middle_y) for x, y in zip(xs, ys, strict=True)) / spread


def growth(points: Sequence[tuple[float, float]]) -> Growth:
    """Lines of least squares through at least two points: log y over log x, and y over the doublings of x."""
    doublings = [math.log2(x) for x, _ in points]
    values = [y for _, y in points]
    return Growth(_slope(doublings, [math.log2(value) for value in values]), _slope(doublings, values))
