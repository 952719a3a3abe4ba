"""What can happen while a step is watched. All of it goes through one queue, so nothing happens twice at once."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Saved:
    """A file of the step changed; `own`: the student's own."""

    name: str
    own: bool = True


@dataclass(frozen=True)
class Vanished:
    """The student's file is gone; it may come back."""

    name: str


@dataclass(frozen=True)
class Noticed:
    """Something to tell about how files are watched."""

    text: str


@dataclass(frozen=True)
class Key:
    """A key was pressed."""

    letter: str


@dataclass(frozen=True)
class Told:
    """What a run said."""

    run: int
    words: dict[str, Any]


@dataclass(frozen=True)
class Ended:
    """A run is over; what it wrote to stderr is there when it ended badly."""

    run: int
    code: int
    errors: str


Event = Saved | Vanished | Noticed | Key | Told | Ended
Post = Callable[[Event], None]
