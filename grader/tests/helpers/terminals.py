"""Programs on a pseudo-terminal, with keys that are pressed while they run."""

import fcntl
import os
import re
import select
import signal
import subprocess
import termios
import time
from collections.abc import Sequence
from pathlib import Path

from raysteps.common.process import kill_process_group

_COLORS = re.compile(r"\x1b\[[0-9;]*m")


def _take_the_terminal() -> None:
    """And hear Ctrl-C there, even where the tests run in the background and do not."""
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Terminal:
    """A pseudo-terminal in which a program runs. Nothing on it is waited for longer than `timeout` seconds."""

    def __init__(self, command: Sequence[str | Path], *, cwd: Path | None = None, timeout: float = 90) -> None:
        self._timeout = timeout
        self._master, self._slave = os.openpty()
        self.before = termios.tcgetattr(self._slave)
        self._read = b""
        self._at = 0
        self.process = subprocess.Popen(
            command,
            cwd=cwd,
            stdin=self._slave,
            stdout=self._slave,
            stderr=self._slave,
            env=os.environ | {"TERM": "xterm", "COLUMNS": "120"},
            start_new_session=True,
            preexec_fn=_take_the_terminal,
        )

    @property
    def printed(self) -> str:
        """What was read so far, without its colours."""
        return _COLORS.sub("", self._read.decode(errors="ignore"))

    def wait(self, text: str) -> str:
        """Everything up to this text, which must be new."""
        until = time.monotonic() + self._timeout
        while (found := self.printed.find(text, self._at)) < 0:
            has_ended = self.process.poll() is not None
            if select.select([self._master], [], [], 0.1)[0]:
                self._read += os.read(self._master, 65536)
            elif has_ended or time.monotonic() > until:
                why = f"exit code {self.process.returncode}" if has_ended else f"waited for {self._timeout} s"
                raise AssertionError(f"{why}, and no '{text}' in:\n{self.printed[self._at :]}")
        before, self._at = self.printed[self._at : found], found + len(text)
        return before

    def press(self, keys: str) -> None:
        os.write(self._master, keys.encode())

    def end(self) -> int:
        return self.process.wait(self._timeout)

    def is_as_before(self) -> bool:
        return termios.tcgetattr(self._slave) == self.before

    def close(self) -> None:
        kill_process_group(self.process)
        self.process.wait()
        os.close(self._master)
        os.close(self._slave)
