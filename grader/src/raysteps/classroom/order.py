"""What was asked for."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from raysteps.classroom.entries import Shard
from raysteps.classroom.graders import KIT_GRADER
from raysteps.judge.feedback import Feedback


@dataclass(frozen=True)
class Order:
    """What was asked for on the command line."""

    folder: Path
    out: Path
    roster: Path | None = None
    jobs: int = 1
    resume: bool = False
    only: tuple[str, ...] = ()
    late_policy: Path | None = None
    seed: int = 1
    feedback: Feedback = "full"
    limits: Mapping[str, float] = field(default_factory=dict)
    require_sandbox: bool = False
    scheduler: str = ""
    shard: Shard = field(default_factory=Shard)
    grader: str = KIT_GRADER
    no_roster: bool = False  # nor that of the last run
    no_late_policy: bool = False
