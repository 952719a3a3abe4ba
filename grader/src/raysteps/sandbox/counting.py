"""A sandbox that adds up what its tasks cost."""

import threading

from raysteps.sandbox.isolation import Isolation
from raysteps.sandbox.task import Ran, Sandbox, Task


class Counted:
    """Hands each task on and keeps the sum of processor seconds. Safe for several threads."""

    def __init__(self, sandbox: Sandbox) -> None:
        self._sandbox = sandbox
        self._lock = threading.Lock()
        self.cpu_seconds = 0.0

    @property
    def isolation(self) -> Isolation:
        return self._sandbox.isolation

    def run(self, task: Task) -> Ran:
        """Runs the task in the sandbox."""
        ran = self._sandbox.run(task)
        with self._lock:
            self.cpu_seconds += ran.cpu_seconds
        return ran
