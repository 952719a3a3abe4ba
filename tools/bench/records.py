"""What a benchmark leaves behind: JSON in build/bench, checked against its schema."""

import json
import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_json
from raysteps.common.schemas import complaint, read_schema
from raysteps.course.project import Project

NAMES = ("boxes", "grading", "render", "scale", "threads", "parse", "loop")


def _checked(name: str, document: Any, where: str) -> Any:
    problem = complaint(document, read_schema("tools.bench", "bench.schema.json", name))
    if problem:
        raise GraderFault(f"{where}: not what `bench {name}` writes: {problem}")
    return document


def place_of(project: Project, name: str) -> Path:
    """Where `bench NAME` puts its numbers."""
    return project.build / "bench" / f"{name}.json"


def keep(project: Project, name: str, document: Any, console: Console) -> None:
    """Writes build/bench/NAME.json and tells so."""
    path = place_of(project, name)
    write_json(path, _checked(name, document, name))
    console.print(f"Numbers: {escape(str(path))}", soft_wrap=True)


def kept(project: Project, name: str) -> Any | None:
    """What was measured last; nothing when it never was."""
    path = place_of(project, name)
    if not path.is_file():
        return None
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise UsageError(f"{path}: not JSON: {error}; measure again: ./raysteps bench {name}") from error
    return _checked(name, document, str(path))


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


# What several measurements of the same thing say.


def spread_of(values: Sequence[float]) -> dict[str, Any]:
    """As raysteps-bench writes it: median, extremes, quartiles and every value."""
    ordered = sorted(values)
    quartiles = statistics.quantiles(ordered, n=4, method="inclusive") if len(ordered) > 1 else ordered * 3
    return {
        "median": statistics.median(ordered),
        "min": ordered[0],
        "max": ordered[-1],
        "q1": quartiles[0],
        "q3": quartiles[2],
        "rounds": list(values),
    }
