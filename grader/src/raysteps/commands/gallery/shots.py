"""What a scene looks like after a step, and what it costs."""

from dataclasses import dataclass

from raysteps.kit.manifest import Step
from raysteps.programs.pictures import Pixels
from raysteps.results.work import Work

_TREE = 6  # the step from which on pictures are made with a tree
_MAP_SIZE = "240x180"  # every surface for every ray takes its time


@dataclass(frozen=True)
class Shot:
    """A picture, or a note why there is none; a note may also go with a picture."""

    pixels: Pixels | None
    note: str = ""


@dataclass(frozen=True)
class Effort:
    """Where the tests went, as a map, and what was counted."""

    name: str
    map: Pixels
    work: Work


def picture_args(step: Step, size: str) -> tuple[str, ...]:
    """Of raytrace. Before there is a tree the reference's saves time; the picture is the same."""
    early = ("--accel", "octree") if step.index < _TREE else ()
    return ("--step", str(step.index), "--size", size, *early)


def map_args(step: int, accel: str) -> tuple[str, ...]:
    """Of raytrace, for a map of the tests of surfaces."""
    return ("--step", str(step), "--size", _MAP_SIZE, "--accel", accel, "--map", "tests")


@dataclass(frozen=True)
class Tree:
    """A step that saves work: what came before it, and what it brings."""

    step: int
    before: tuple[str, tuple[str, ...]]
    after: tuple[str, tuple[str, ...]]


TREES = (
    Tree(6, ("every surface", map_args(5, "none")), ("octree", map_args(6, "octree"))),
    Tree(9, ("octree", map_args(8, "octree")), ("bounding volumes", map_args(9, "bvh"))),
)
