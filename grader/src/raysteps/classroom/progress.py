"""Shows how far a class is: a bar on a terminal, lines elsewhere."""

import sys
import time
from types import TracebackType

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

from raysteps.common.text import printable, shorten


def _span(seconds: float) -> str:
    if seconds < 90:
        return f"{max(1, round(seconds))} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 90 else f"{minutes // 60} h {minutes % 60} min"


def first_line(text: str) -> str:
    """Of a fault: the rest stands in fault.txt."""
    return shorten(printable(text).split("\n", 1)[0], 300)


class Meter:
    """Counts submissions. What was graded before takes no time and says nothing about the time left."""

    def __init__(self, console: Console, total: int) -> None:
        self._console = console
        self._total = total
        self._done = 0
        self._graded = 0
        self._start = time.monotonic()
        self._bar: Progress | None = None
        if console.is_terminal:
            columns = (
                TextColumn("{task.description}"),
                BarColumn(),
                MofNCompleteColumn(),
                TextColumn("{task.fields[left]}"),
            )
            self._bar = Progress(*columns, console=console, transient=True)
            self._task = self._bar.add_task("grading", total=total, left="")

    def __enter__(self) -> "Meter":
        if self._bar is not None:
            self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.stop()

    def say(self, text: str) -> None:
        """A line of its own."""
        if self._bar is not None:
            self._bar.console.print(escape(text), soft_wrap=True)
        else:
            print(f"raysteps: {text}", file=sys.stderr, flush=True)

    def _left(self) -> str:
        left = self._total - self._done
        if not self._graded or not left:
            return ""
        return f"about {_span((time.monotonic() - self._start) / self._graded * left)} left"

    def skip(self) -> None:
        """One that need not be graded."""
        self._done += 1
        if self._bar is not None:
            self._bar.update(self._task, completed=self._done)

    def count(self, name: str, what: str) -> None:
        """One that was graded."""
        self._done += 1
        self._graded += 1
        left = self._left()
        if self._bar is not None:
            self._bar.update(self._task, completed=self._done, description=escape(name), left=left)
        else:
            self.say(f"{self._done} of {self._total}: {name}: {what}" + (f"; {left}" if left else ""))
