"""No sandbox, only limits: for one's own work, and where there is nothing better."""

from pathlib import Path
from typing import Any

from raysteps.sandbox.isolation import Isolation
from raysteps.sandbox.kept import Kept
from raysteps.sandbox.task import Input, Task
from raysteps.sandbox.workplace import Workplace


class OpenAir(Kept):
    """The task can do whatever the person who started the grader can do."""

    isolation = Isolation(
        "limits only",
        strong=False,
        description=(
            "The code ran without a sandbox, under limits on time, memory and output: it could read the grader's "
            "files and use the network."
        ),
    )

    def _locate(self, place: Workplace, given: Input) -> Path:
        return place.linked(given.path, given.inner_name)

    def _fences(self, task: Task, inputs: list[Path], folders: list[Path]) -> dict[str, Any] | None:
        return None
