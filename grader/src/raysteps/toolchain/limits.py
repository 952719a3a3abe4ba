"""The limits of a step: what its manifest says, and what a course changes."""

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from raysteps.common.documents import Amount
from raysteps.common.errors import UsageError
from raysteps.course.manifest import LIMIT_NAMES, Step
from raysteps.sandbox.task import Limits

COMPILE_SECONDS = 60.0
COMPILE_MEMORY_MB = 2048
PROCESSES = 64
FILE_MB = 64
_OF_ALL = "submission_seconds"
_ON_THE_COMMAND_LINE = (*LIMIT_NAMES, _OF_ALL)
SUBMISSION_SECONDS = 1800.0  # an honest submission takes some minutes, on a slow machine too
_GIVE_UP_FACTOR = 2
PATIENT_STOPS = 2
LEAST_SECONDS = 1.0  # that say something
_PATIENCE = 4  # seconds on the clock for one of a processor: others may use the machine, too


@dataclass(frozen=True)
class StepLimits:
    """`seconds` is processor time for one program, with all its processes, and `compile_seconds` for one run of the
    compiler, so that a busy machine changes no grade. On the clock each may take four times as long."""

    seconds: float
    memory_mb: int
    compile_seconds: float = COMPILE_SECONDS
    compile_memory_mb: int = COMPILE_MEMORY_MB
    processes: int = PROCESSES
    file_mb: int = FILE_MB
    stops: int = 0  # of programs of the step so far, at a limit on time or memory

    def after_a_stop(self) -> "StepLimits":
        """Two programs may run into a limit, on time or on memory; those after them must do with a quarter of the
        time, as others wait."""
        less = min(self.seconds, max(LEAST_SECONDS, self.seconds / 4))
        return replace(self, stops=self.stops + 1, seconds=less if self.stops + 1 == PATIENT_STOPS else self.seconds)

    @property
    def is_impatient(self) -> bool:
        """Whether programs have less time than the step says, as some were stopped."""
        return self.stops >= PATIENT_STOPS

    def of_tools(self) -> Limits:
        """For the compiler, the assembler and the linker."""
        return Limits(
            wall_seconds=_PATIENCE * self.compile_seconds,
            cpu_seconds=self.compile_seconds,
            memory_mb=self.compile_memory_mb,
            processes=self.processes,
            file_mb=self.file_mb,
        )

    def of_program(self, seconds: float | None = None) -> Limits:
        """For the student's programs."""
        most = self.seconds if seconds is None else seconds
        return Limits(
            wall_seconds=_PATIENCE * most,
            cpu_seconds=most,
            memory_mb=self.memory_mb,
            processes=self.processes,
            file_mb=self.file_mb,
        )


def limits_of(step: Step, changes: Mapping[str, float], slowness: float = 1.0) -> StepLimits:
    """The manifest's limits with the changes by name (see LIMIT_NAMES). `slowness` of this machine: so many times as
    long as the manifest says, where nobody says otherwise."""
    given = dict(step.more_limits)
    given = {"seconds": step.seconds * slowness, "memory_mb": step.memory_mb, **given, **changes}
    return StepLimits(
        seconds=given["seconds"],
        memory_mb=int(given["memory_mb"]),
        compile_seconds=given.get("compile_seconds", COMPILE_SECONDS),
        compile_memory_mb=int(given.get("compile_memory_mb", COMPILE_MEMORY_MB)),
        processes=int(given.get("processes", PROCESSES)),
        file_mb=int(given.get("file_mb", FILE_MB)),
    )


def submission_seconds(changes: Mapping[str, float]) -> float:
    """How long all programs of a submission may run together: each may stay below its own limit, and there are many."""
    return changes.get(_OF_ALL, SUBMISSION_SECONDS)


def give_up_after(changes: Mapping[str, float]) -> float:
    """Seconds on the clock after which a grader itself is ended, whatever it is at: it needs some for its own work."""
    return _GIVE_UP_FACTOR * submission_seconds(changes)


_listeners: list[int] = []  # the end of a pipe to whoever ends a grader that hangs


def tell_of_restarts(listener: int) -> None:
    _listeners.append(listener)


def restart_clock() -> None:
    """What was done until now was the grader's own work, such as building the kit: no submission's time."""
    for listener in _listeners:
        os.write(listener, b".")


LIMIT_HELP = "another limit for all steps, such as seconds=40 or memory_mb=512; may be given several times"


def parse_limits(words: Sequence[str]) -> dict[str, Amount]:
    """`NAME=VALUE` words of a command line."""
    changes: dict[str, Amount] = {}
    for word in words:
        name, _, value = word.partition("=")
        whole = not name.endswith("seconds")
        if (
            name not in _ON_THE_COMMAND_LINE
            or not re.fullmatch(r"[0-9]+" if whole else r"[0-9]+(\.[0-9]+)?", value)
            or not float(value)
        ):
            kind = "a whole number" if whole else "a number"
            names = ", ".join(_ON_THE_COMMAND_LINE)
            raise UsageError(f"--limit {word}: expected one of {names}, then = and {kind} above 0, such as seconds=40")
        changes[name] = float(value)
    return changes
