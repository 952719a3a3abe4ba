"""How an instructor wants a submission to be graded."""

from dataclasses import dataclass, field
from typing import Literal

from raysteps.common.documents import Amount

Feedback = Literal["full", "diagnosis", "score"]  # how much a student is told about the hidden part


@dataclass(frozen=True)
class Settings:
    """Together with the kit and the submission this fixes a grade."""

    feedback: Feedback = "full"
    limits: dict[str, Amount] = field(default_factory=dict)  # changes by name, see toolchain.limits
    only: tuple[str, ...] = ()  # step ids; all steps when there are none
    seed: int = 1
