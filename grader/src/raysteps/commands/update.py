"""The command `update`."""

import argparse
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import UsageError
from raysteps.common.text import count, listed
from raysteps.kit.project import Project
from raysteps.students.listing import PLACE, read_release
from raysteps.students.source import open_source
from raysteps.students.updating import Changes, Update


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where the newer kit is."""
    parser.add_argument("kit", type=Path, metavar="KIT", help="a newer release: a folder or a zip")


def _say(console: Console, text: str) -> None:
    console.print(escape(text), highlight=False, soft_wrap=True)


def _tell(console: Console, changes: Changes, new_steps: list[str]) -> None:
    if not changes.any:
        _say(console, "The kit is up to date: nothing had to be changed.")
    else:
        numbers = ((changes.replaced, "replaced"), (changes.added, "added"), (changes.removed, "removed"))
        _say(console, f"Files of the kit: {', '.join(f'{len(paths)} {word}' for paths, word in numbers)}.")
    if new_steps:
        _say(console, f"New: {listed(new_steps)}.")
    for path in changes.kept:
        _say(console, f"You had changed a file of the kit; yours is kept as {path}")
    for path in changes.left:
        _say(console, f"The kit has no {path} any more; yours is still there")
    for path in changes.stubs:
        _say(console, f"{path} is as you left it, but its stub has changed: compare with grader/stubs/{path[6:]}")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """What the student wrote stays byte for byte."""
    old = read_release(project.root)
    if old is None:
        raise UsageError(
            f"{project.root / PLACE}: is missing; expected a repository that came from a release of the kit"
        )
    kit: Path = arguments.kit
    if kit.is_dir() and kit.resolve() == project.root.resolve():
        raise UsageError(f"{kit}: is this repository; expected a newer release beside it")
    with open_source(kit) as source:
        try:
            changes = Update(project.root, old, source).run()
        except OSError as error:
            where = f"{error.filename}: " if error.filename else ""
            raise UsageError(f"{where}{error.strerror or error}. Your work is unharmed; call update again") from error
        _tell(console, changes, [step for step in source.release.steps if step not in old.steps])
        _say(
            console,
            f"{count(len(source.release.steps), 'step')} of {source.release.course}. Your own files are as they were.",
        )
    return 0
