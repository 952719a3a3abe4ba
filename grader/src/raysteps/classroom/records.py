"""What the database is told at the beginning of a run."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

Scope = Literal["here", "elsewhere", "gone"]  # "elsewhere": it belongs to another shard


@dataclass(frozen=True)
class Registered:
    """An entry of the folder as the database keeps it."""

    entry: str
    name: str
    scope: Scope
    submitted_at: str = ""
    submitted_from: str = ""
    note: str = ""


@dataclass(frozen=True)
class Registration:
    """A student, and the entries that are this student's."""

    id: str
    name: str
    email: str
    entries: tuple[str, ...]
    note: str = ""


@dataclass(frozen=True)
class RunFacts:
    """How a run grades. `uid` tells it from the runs of all other databases."""

    uid: str
    kit: str
    folder: str
    shard: str
    settings: Mapping[str, Any]
    steps: list[dict[str, Any]]
    late_policy: str
    ignored: list[str]
    roster: str = "[]"  # JSON: its lines as they were read
    files: list[str] = field(default_factory=list)  # where roster and late policy lay
