"""What can happen while a step is watched. All of it goes through one queue, so nothing happens twice at once."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from raysteps.results.model import StepResult

Owner = Literal["step", "earlier", "kit"]  # the student's file of this step, of one before it, or one of the kit


@dataclass(frozen=True)
class FileSaved:
    """A file changed that the step's program is built from; several at once are one save."""

    name: str
    owner: Owner = "step"


@dataclass(frozen=True)
class FileVanished:
    """The student's file is gone; it may come back."""

    name: str


@dataclass(frozen=True)
class WatchNotice:
    """Something to tell about how files are watched."""

    text: str


@dataclass(frozen=True)
class Key:
    """A key was pressed."""

    letter: str


@dataclass(frozen=True)
class WorkerLine:
    """What a worker tells in a line of JSON: what it does, what came of it so far, or what is wrong."""

    say: str = ""
    result: StepResult | None = None
    out: str = ""  # folder of the pictures of the result
    complete: bool = False  # whether the result is the last
    error: str = ""


@dataclass(frozen=True)
class WorkerMessage:
    """What a run said."""

    run: int
    line: WorkerLine


@dataclass(frozen=True)
class WorkerEnded:
    """A run is over; what it wrote to stderr is there when it ended badly."""

    run: int
    code: int
    errors: str


@dataclass(frozen=True)
class InspectEnded:
    """What looked into a pixel is over."""

    run: int


Event = FileSaved | FileVanished | WatchNotice | Key | WorkerMessage | WorkerEnded | InspectEnded
Post = Callable[[Event], None]
