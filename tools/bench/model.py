"""What the commands `raysteps bench ...` write to build/bench: these classes are its forms."""

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar, Literal, TypedDict, TypeVar

from msgspec import Meta
from rich.console import Console
from rich.markup import escape

from raysteps.common.documents import Amount, Count, Malformed, convert, parse, plain
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_json
from raysteps.course.project import Project

Number = int | float
Several = Annotated[int, Meta(ge=1)]
Values = Annotated[list[Amount], Meta(min_length=1)]


@dataclass(frozen=True)
class Machine:
    """What the numbers were measured on, without the name of the machine."""

    processor: str
    cores: Several
    system: str
    compiler: str
    flags: str
    pinned: bool


@dataclass(frozen=True)
class Spread:
    """What several measurements of the same thing say; as raysteps-bench writes it."""

    median: Amount
    min: Amount
    max: Amount
    q1: Amount
    q3: Amount
    rounds: Values

    @classmethod
    def of(cls, values: Sequence[float]) -> "Spread":
        ordered = sorted(values)
        quartiles = statistics.quantiles(ordered, n=4, method="inclusive") if len(ordered) > 1 else ordered * 3
        return cls(statistics.median(ordered), ordered[0], ordered[-1], quartiles[0], quartiles[2], list(values))


def geometric_mean(values: Sequence[float]) -> float:
    """Of numbers above 0."""
    return math.exp(math.fsum(math.log(value) for value in values) / len(values))


# bench render


@dataclass(frozen=True)
class ListedStructure:
    """What raysteps-bench can measure."""

    name: str
    slow: bool
    foreign: bool


@dataclass(frozen=True)
class Listing:
    """The answer to `raysteps-bench list`."""

    schema: Literal["raysteps/bench-structures/v1"]
    embree_version: str
    structures: list[ListedStructure]


@dataclass(frozen=True)
class StructureTimes:
    """The rays of a picture, asked of one structure."""

    name: str
    rays: Count
    differing: Count
    build_seconds: Spread
    boxes: Count
    references: Count
    bytes: Count
    surface_tests_per_ray: Amount
    box_tests_per_ray: Amount
    ns_per_ray: Spread
    picture_seconds: Spread | None


@dataclass(frozen=True)
class RayKinds:
    """How many rays a picture takes."""

    all: Count
    eye: Count
    shadow: Count
    reflect: Count
    refract: Count
    any_hit: Count


@dataclass(frozen=True)
class SceneRays:
    """The answer to `raysteps-bench render`."""

    schema: Literal["raysteps/bench-rays/v1"]
    scene: str
    surfaces: Count
    size: Count
    depth: Count
    every: Count
    embree_version: str
    rays: RayKinds
    structures: Annotated[list[StructureTimes], Meta(min_length=1)]


@dataclass(frozen=True)
class BuildRays:
    """All scenes with one build."""

    build: str
    machine: Machine
    scenes: Annotated[list[SceneRays], Meta(min_length=1)]


@dataclass(frozen=True)
class ProgramTimes:
    """One picture by one program."""

    program: str
    trace_seconds: Spread
    trace_processor_seconds: Spread
    process_seconds: Spread
    processor_seconds: Spread


@dataclass(frozen=True)
class PovrayRow:
    """One picture by POV-Ray, then by ours; or why it was skipped."""

    scene: str
    skipped: str
    brightness_difference: Number | None
    programs: list[ProgramTimes]


@dataclass(frozen=True, kw_only=True)
class RenderNumbers:
    """Rays beside Embree's, and pictures beside POV-Ray's."""

    name: ClassVar[str] = "render"
    schema: Literal["raysteps/bench-render/v1"] = "raysteps/bench-render/v1"
    builds: Annotated[list[BuildRays], Meta(min_length=1)]
    povray: list[PovrayRow]


# bench mitsuba


@dataclass(frozen=True)
class PathTimes:
    """One program on one scene: what its picture takes, how far a pixel scatters, and its mean light."""

    program: str
    seconds: Spread
    variance: Amount
    mean: Amount


@dataclass(frozen=True)
class MitsubaRow:
    """One picture by Mitsuba, then by ours."""

    scene: str
    programs: Annotated[list[PathTimes], Meta(min_length=2)]


@dataclass(frozen=True, kw_only=True)
class MitsubaNumbers:
    """Paths beside Mitsuba's."""

    name: ClassVar[str] = "mitsuba"
    schema: Literal["raysteps/bench-mitsuba/v1"] = "raysteps/bench-mitsuba/v1"
    machine: Machine
    version: str
    size: Several
    samples: Several
    rows: Annotated[list[MitsubaRow], Meta(min_length=1)]


# bench scale


@dataclass(frozen=True)
class ScaleRow:
    """One structure on one scene of one size."""

    structure: str
    scene: str
    surfaces: Count
    rays: Count
    boxes: Count
    references: Count
    bytes: Count
    surface_tests_per_ray: Amount
    box_tests_per_ray: Amount
    peak_bytes: int | None
    build_seconds: Spread
    ns_per_ray: Spread

    @property
    def tests_per_ray(self) -> float:
        """Surfaces and boxes together."""
        return float(self.surface_tests_per_ray + self.box_tests_per_ray)


GrowthRow = TypedDict(  # a dataclass has no field that is called `from`
    "GrowthRow",
    {
        "structure": str,
        "scene": str,
        "from": Count,
        "to": Count,
        "tests_exponent": Number,
        "tests_per_doubling": Number,
        "time_exponent": Number,
    },
)


@dataclass(frozen=True, kw_only=True)
class ScaleNumbers:
    """How building, memory and tests grow."""

    name: ClassVar[str] = "scale"
    schema: Literal["raysteps/bench-scale/v1"] = "raysteps/bench-scale/v1"
    machine: Machine
    rows: Annotated[list[ScaleRow], Meta(min_length=1)]
    growth: list[GrowthRow]


# bench threads, parse, loop, waits, boxes and grading


@dataclass(frozen=True)
class ThreadsRow:
    """One scene with one structure on so many threads."""

    scene: str
    accel: str
    threads: Several
    render_seconds: Spread
    build_seconds: Spread
    speed_up: Amount


@dataclass(frozen=True, kw_only=True)
class ThreadsNumbers:
    """What more processors bring."""

    name: ClassVar[str] = "threads"
    schema: Literal["raysteps/bench-threads/v1"] = "raysteps/bench-threads/v1"
    machine: Machine
    rows: Annotated[list[ThreadsRow], Meta(min_length=1)]


@dataclass(frozen=True)
class ParseRow:
    """One scene, read."""

    scene: str
    bytes: Count
    surfaces: Count
    megabytes_per_second: Spread


@dataclass(frozen=True, kw_only=True)
class ParseNumbers:
    """How fast scenes are read."""

    name: ClassVar[str] = "parse"
    schema: Literal["raysteps/bench-parse/v1"] = "raysteps/bench-parse/v1"
    machine: Machine
    rows: Annotated[list[ParseRow], Meta(min_length=1)]


@dataclass(frozen=True)
class LoopRow:
    """One step, changed and checked."""

    step: str
    seconds: Spread


@dataclass(frozen=True, kw_only=True)
class LoopNumbers:
    """From a saved file to the result of check."""

    name: ClassVar[str] = "loop"
    schema: Literal["raysteps/bench-loop/v1"] = "raysteps/bench-loop/v1"
    machine: Machine
    rows: Annotated[list[LoopRow], Meta(min_length=1)]


@dataclass(frozen=True)
class WaitsRow:
    """One thing that is waited for."""

    what: str
    seconds: Spread
    processor_seconds: Spread | None


@dataclass(frozen=True, kw_only=True)
class WaitsNumbers:
    """How long a person waits."""

    name: ClassVar[str] = "waits"
    schema: Literal["raysteps/bench-waits/v1"] = "raysteps/bench-waits/v1"
    machine: Machine
    rows: Annotated[list[WaitsRow], Meta(min_length=1)]


@dataclass(frozen=True)
class BoxesRow:
    """One scene rendered in one way."""

    scene: str
    accel: str
    objects: Count
    share_tested: Amount
    tests_per_ray: Amount
    seconds: Amount
    time_saved: Number
    speed_up: Amount


@dataclass(frozen=True, kw_only=True)
class BoxesNumbers:
    """What boxes save."""

    name: ClassVar[str] = "boxes"
    schema: Literal["raysteps/bench-boxes/v1"] = "raysteps/bench-boxes/v1"
    size: str
    rows: Annotated[list[BoxesRow], Meta(min_length=1)]


@dataclass(frozen=True)
class Cost:
    """Of one submission, on average over one run."""

    way: str  # the plain way; in a class: all steps, or one of them
    run: Count
    submissions: Count
    seconds: Amount
    cpu_seconds: Amount


@dataclass(frozen=True)
class MeanCost:
    """Of all runs of one way."""

    way: str
    runs: int
    submissions: int
    seconds: float
    cpu_seconds: float


def mean_costs(costs: Sequence[Cost]) -> list[MeanCost]:
    """Of each way, in the order in which they were measured."""
    found = []
    for way in dict.fromkeys(cost.way for cost in costs):
        runs = [cost for cost in costs if cost.way == way]
        seconds, processor = sum(one.seconds for one in runs), sum(one.cpu_seconds for one in runs)
        found.append(MeanCost(way, len(runs), runs[0].submissions, seconds / len(runs), processor / len(runs)))
    return found


@dataclass(frozen=True, kw_only=True)
class GradingNumbers:
    """A submission in a class, against the plain way."""

    name: ClassVar[str] = "grading"
    schema: Literal["raysteps/bench-grading/v2"] = "raysteps/bench-grading/v2"
    machine: Machine
    costs: Annotated[list[Cost], Meta(min_length=1)]


# bench play


@dataclass(frozen=True)
class SaveRow:
    """One step in the page to work in: from a save to its first picture."""

    step: str
    first: Amount
    later: Spread


@dataclass(frozen=True)
class FigureRow:
    """One live figure while a handle of it is dragged: the time between two frames in which it is drawn anew."""

    step: str
    figure: str
    per_second: Amount
    median: Amount  # milliseconds
    most: Amount  # of 95 % of them


@dataclass(frozen=True, kw_only=True)
class PlayNumbers:
    """How long people wait in the page to work in."""

    name: ClassVar[str] = "play"
    schema: Literal["raysteps/bench-play/v1"] = "raysteps/bench-play/v1"
    machine: Machine
    browser: str
    first_bytes: Count
    first_seconds: Amount
    memory_bytes: Count
    rows: Annotated[list[SaveRow], Meta(min_length=1)]
    figures: list[FigureRow]


Numbers = (
    BoxesNumbers
    | GradingNumbers
    | RenderNumbers
    | MitsubaNumbers
    | ScaleNumbers
    | ThreadsNumbers
    | ParseNumbers
    | LoopNumbers
    | WaitsNumbers
    | PlayNumbers
)


# What a benchmark leaves behind: JSON in build/bench.

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
