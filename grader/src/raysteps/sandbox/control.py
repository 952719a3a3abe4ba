"""The two pipes between the grader and a bubblewrap: it says who its first process is and how the command ended,
and it waits for a sign before it starts the command."""

import json
import os
import select
import time
from contextlib import ExitStack

_START_SECONDS = 30.0


def readable(fd: int, seconds: float) -> bool:
    """Whether there is something to read, or an end, within that time."""
    poll = select.poll()
    poll.register(fd, select.POLLIN)
    return bool(poll.poll(max(0.0, seconds) * 1000))


class Control:
    """Holds the grader's ends until the stack is left."""

    def __init__(self, stack: ExitStack) -> None:
        self._status, self.status_fd = os.pipe()
        self.gate_fd, self._gate = os.pipe()
        self._open = {self._status, self.status_fd, self.gate_fd, self._gate}
        stack.callback(lambda: self._close(*self._open))
        self._said = b""

    def _close(self, *fds: int) -> None:
        for fd in self._open & set(fds):
            self._open.remove(fd)
            os.close(fd)

    def words(self) -> list[str]:
        return ["--json-status-fd", str(self.status_fd), "--block-fd", str(self.gate_fd)]

    def hand_over(self) -> None:
        """The other ends are bubblewrap's now."""
        self._close(self.status_fd, self.gate_fd)

    def first_process(self) -> int | None:
        """The process that is number 1 inside; none when bubblewrap could not make it."""
        until = time.monotonic() + _START_SECONDS
        while b"\n" not in self._said and readable(self._status, until - time.monotonic()):
            part = os.read(self._status, 4096)
            if not part:
                return None
            self._said += part
        return int(json.loads(self._said.split(b"\n")[0])["child-pid"]) if b"\n" in self._said else None

    def open_gate(self) -> None:
        os.write(self._gate, b"\n")
        self._close(self._gate)

    def exit_code(self) -> int | None:
        """Of the command; none when it was never started, or killed. To be asked when bubblewrap has ended."""
        while readable(self._status, 0) and (part := os.read(self._status, 4096)):
            self._said += part
        for line in self._said.splitlines():
            said = json.loads(line)
            if "exit-code" in said:
                return int(said["exit-code"])
        return None
