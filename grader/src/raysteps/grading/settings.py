"""How an instructor wants a submission to be graded."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from raysteps.judge.feedback import Feedback


@dataclass(frozen=True)
class Settings:
    """Together with the kit and the submission this fixes a grade."""

    seed: int = 1
    only: tuple[str, ...] = ()  # step ids; all steps when there are none
    feedback: Feedback = "full"
    limits: Mapping[str, float] = field(default_factory=dict)  # changes by name, see programs.limits
    jobs: int = 1  # steps at a time; changes a grade only where a step is near its time limit
