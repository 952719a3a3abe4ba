"""The command `reset`: the stub again, and the student's own lines kept elsewhere."""

import difflib
import sys
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import UsageError
from raysteps.common.files import normalized_line_ends, write_bytes
from raysteps.common.text import count, print_plain, printable, shorten
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub
from raysteps.progress.standing import shown

_MAX_SHOWN = 12
_WIDEST = 110

Confirm = Callable[[str], bool]


@dataclass(frozen=True)
class LostLines:
    """What a step's file has beyond the stub: lines of the student's own, and lines of the stub that are gone."""

    own: tuple[str, ...]
    gone: int

    def __str__(self) -> str:
        own, gone = count(len(self.own), "line") + " of your own", count(self.gone, "line") + " of the stub"
        return f"{own} would be put away, {gone} would come back"


def own_file(project: Project, step: Step) -> Path:
    return project.steps / step.path


def lost_lines(project: Project, step: Step) -> LostLines | None:
    """None where there is nothing to lose: no file, or the stub as it was."""
    try:
        data = own_file(project, step).read_bytes()
    except FileNotFoundError:
        return None
    stub = pristine_stub(project, step)
    if normalized_line_ends(data) == stub.encode():
        return None
    lines = difflib.ndiff(stub.splitlines(), data.decode("utf-8", "replace").splitlines())
    changes = [line for line in lines if line[:1] in "+-"]
    own = tuple(printable(line[2:]) for line in changes if line[0] == "+" and line[2:].strip())
    return LostLines(own, sum(line[0] == "-" and bool(line[2:].strip()) for line in changes))


def _backup(project: Project, step: Step, data: bytes) -> Path:
    now = f"{datetime.now():%Y%m%d-%H%M%S}"
    folder = project.build / "reset"
    names = (f"{now}{extra}-{step.file}" for extra in ("", *(f".{number}" for number in range(2, 1000))))
    path = next(folder / name for name in names if not (folder / name).exists())
    write_bytes(path, data)
    return path


def put_back(project: Project, step: Step) -> Path | None:
    """Writes the stub; returns where the old file is kept now, if there was one."""
    file = own_file(project, step)
    stub = pristine_stub(project, step).encode()
    kept = _backup(project, step, file.read_bytes()) if file.is_file() else None
    write_bytes(file, stub)
    return kept


def print_loss(console: Console, lost: LostLines, name: str) -> None:
    """What is at stake, before anything is done."""
    print_plain(console, f"{name}: {lost}.")
    for line in lost.own[:_MAX_SHOWN]:
        console.print(f"  [yellow]{escape(shorten(line, _WIDEST))}[/yellow]", highlight=False, soft_wrap=True)
    if len(lost.own) > _MAX_SHOWN:
        console.print(f"  … and {count(len(lost.own) - _MAX_SHOWN, 'more line')}", style="dim")


def print_done(console: Console, name: str, kept: Path | None) -> None:
    """What was done, and where the old file is."""
    print_plain(console, f"{name} is the stub again.")
    if kept is not None:
        print_plain(console, f"The old file is kept: {kept}")


def _ask(question: str) -> bool:
    try:
        return input(f"{question} [y/N] ").strip().lower() in ("y", "yes")
    except EOFError:
        return False


def reset(project: Project, step: Step, console: Console, *, yes: bool, confirm: Confirm | None = None) -> int:
    """Asks first, unless there is nothing to lose. `confirm` stands in for the question on the terminal."""
    name = shown(project, step, step.file)
    if own_file(project, step).is_dir():
        raise UsageError(f"{name}: is a folder; expected a file. Move the folder away, then reset the step again")
    lost = lost_lines(project, step)
    if lost is None and own_file(project, step).is_file():
        print_plain(console, f"{name} is the stub already.")
        return 0
    if lost is not None and not yes:
        if confirm is None and not sys.stdin.isatty():
            raise UsageError(f"{name}: {lost}, and there is no terminal to ask on; say --yes if that is meant")
        print_loss(console, lost, name)
        if not (confirm or _ask)("Put the stub back?"):
            console.print("Nothing was changed.")
            return 0
    print_done(console, name, put_back(project, step))
    return 0
