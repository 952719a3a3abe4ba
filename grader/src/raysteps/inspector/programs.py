"""The program inspect: run, and its record read."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from raysteps.common.documents import Malformed, parse
from raysteps.common.errors import UsageError
from raysteps.common.process import Outcome, run
from raysteps.common.text import in_seconds, printable
from raysteps.course.manifest import Step
from raysteps.inspector.model import Record

_SECONDS = 30
_MAX_BYTES = 64 << 20
_USAGE = 2


@dataclass(frozen=True)
class InspectOptions:
    """Which pixel of what; `options` are those of the program."""

    scene: str
    x: str
    y: str
    step: int
    options: tuple[str, ...] = ()
    path: str | None = None  # which sample of the pixel; there is but one before part two

    def words(self) -> list[str]:
        path = () if self.path is None else ("--path", self.path)
        return [self.scene, self.x, self.y, "--step", str(self.step), *self.options, *path]

    def of_step(self, step: Step) -> "InspectOptions":
        """The same pixel after an earlier step."""
        return replace(self, step=step.index, path=self.path if step.is_in_part_two else None)


@dataclass(frozen=True)
class InspectResult:
    """What the program said; `problem` is set where it did not come to its end."""

    text: str = ""
    record: Record | None = None
    remarks: str = ""  # from stderr, such as functions that are not written yet
    problem: str = ""


def _problem(outcome: Outcome) -> str:
    if outcome.timed_out:
        return f"did not come to an end in {in_seconds(_SECONDS)}. Is there an endless loop?"
    if outcome.signal_name is not None:
        return f"crashed ({outcome.signal_words})."
    return f"gave up with exit code {outcome.code}" if outcome.code != 0 else ""


def _read(path: Path) -> tuple[Record | None, str]:
    """Or what is wrong with it."""
    try:
        text = path.read_text(encoding="utf-8", errors="replace")  # a scene's name may be any bytes
        return parse(text.encode(), Record), ""
    except OSError:
        return None, "left no record that can be read"
    except (Malformed, RecursionError) as error:
        return None, f"left no record that can be read: {error}"


def inspect(program: Path, options: InspectOptions, *, seconds: float = _SECONDS) -> InspectResult:
    """Runs the program once; bad input is a usage error, whatever the steps are like."""
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        file = Path(folder) / "record.json"
        outcome = run([program, *options.words(), "--json", file], seconds=seconds, cap=_MAX_BYTES)
        said = printable(outcome.stderr).strip()
        if outcome.code == _USAGE and not outcome.timed_out:
            raise UsageError(said.removeprefix("raysteps inspect: ") or "inspect gave up without a word")
        problem = _problem(outcome)
        record, problem = (None, problem) if problem else _read(file)
    return InspectResult(printable(outcome.stdout), record, said, problem)


def last_good_step(program: Path, options: InspectOptions, steps: Sequence[Step], *, seconds: float = 10) -> int:
    """Up to which step the program comes to its end; 0: not even in the first."""
    good = 0
    for step in steps:
        if step.index >= options.step:
            break
        outcome = run([program, *options.of_step(step).words(), "--quiet"], seconds=seconds)
        if outcome.code != 0 or outcome.timed_out:
            break
        good = step.index
    return good
