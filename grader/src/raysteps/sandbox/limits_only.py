"""No sandbox, only limits: for one's own work, and where there is nothing better."""

import sys
from pathlib import Path
from typing import Any

from raysteps.sandbox.task import Isolation

_ISOLATION = Isolation(
    "limits only",
    strong=False,
    description=(
        "The code ran without a sandbox, under limits on time, memory and output: it could read the grader's "
        "files and use the network."
    ),
)

if sys.platform == "win32":
    from raysteps.sandbox.windows import UnsupervisedSandbox

    class LimitsOnly(UnsupervisedSandbox):
        """The task can do whatever the person who started the grader can do."""

        isolation = _ISOLATION

else:
    from raysteps.sandbox.supervised import SupervisedSandbox
    from raysteps.sandbox.task import Input, Task
    from raysteps.sandbox.task_dir import TaskDir

    class LimitsOnly(SupervisedSandbox):
        """The task can do whatever the person who started the grader can do."""

        isolation = _ISOLATION

        def _locate(self, place: TaskDir, given: Input, *, to_run: bool) -> Path:
            return place.linked(given.path, given.inner_name)

        def _fences(self, task: Task, inputs: list[Path], folders: list[Path]) -> dict[str, Any] | None:
            return None
