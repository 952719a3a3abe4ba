"""What can happen while a step is watched. All of it goes through one queue, so nothing happens twice at once."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class FileSaved:
    """A file of the step changed; `own`: the student's own."""

    name: str
    own: bool = True


@dataclass(frozen=True)
class FileVanished:
    """The student's file is gone; it may come back."""

    name: str


@dataclass(frozen=True)
class ChangeNoticed:
    """Something to tell about how files are watched."""

    text: str


@dataclass(frozen=True)
class Key:
    """A key was pressed."""

    letter: str


@dataclass(frozen=True)
class WorkerMessage:
    """What a run said."""

    run: int
    words: dict[str, Any]


@dataclass(frozen=True)
class WorkerEnded:
    """A run is over; what it wrote to stderr is there when it ended badly."""

    run: int
    code: int
    errors: str


Event = FileSaved | FileVanished | ChangeNoticed | Key | WorkerMessage | WorkerEnded
Post = Callable[[Event], None]
