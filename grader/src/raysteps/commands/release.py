"""The command `release`."""

import argparse
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.commands.progress import progress
from raysteps.common.errors import UsageError
from raysteps.common.text import count
from raysteps.kit.kit_building import build_kit
from raysteps.kit.project import Project
from raysteps.release.leaks.finding import Leak, find_leaks, leaks_in_history
from raysteps.release.leaks.secrets import gather
from raysteps.release.making import first_steps, release
from raysteps.release.replacing import usable

_MOST_SHOWN = 20


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where to, and what of it; or what to look through."""
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--out", type=Path, metavar="DIR", help="a new or empty folder, or an earlier release")
    where.add_argument("--check", type=Path, metavar="DIR", help="look for solutions in every file there")
    parser.add_argument("--steps", metavar="1-N", help="the first steps only, such as 1-4")
    parser.add_argument("--course", default="Raysteps", metavar="NAME", help="for the README (Raysteps)")


def _tell(console: Console, leaks: list[Leak]) -> bool:
    for leak in leaks[:_MOST_SHOWN]:
        console.print(f"[red]leak[/red]  {escape(str(leak))}", highlight=False, soft_wrap=True)
    if len(leaks) > _MOST_SHOWN:
        console.print(f"      and {count(len(leaks) - _MOST_SHOWN, 'more')}", highlight=False)
    return bool(leaks)


def refuse_inside(project: Project, out: Path) -> None:
    """A release among the files of the kit would be taken for a part of it, and given out with the next one."""
    root = project.root.resolve()
    if out == root or (root in out.parents and project.build.resolve() not in out.parents):
        raise UsageError(f"{out}: lies in the kit's own folder; expected one elsewhere, such as ../{out.name}")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when nothing leaks, else 1."""
    if not project.has_reference:
        raise UsageError("a students' kit cannot be released; expected the whole kit, with solutions/")
    secrets = gather(project)
    if arguments.check is not None:
        if not arguments.check.is_dir():
            raise UsageError(f"{arguments.check}: expected the folder of a release")
        found = find_leaks(secrets, arguments.check)
        if not _tell(console, found):
            console.print("No solution was found in it.")
        return 1 if found else 0
    if "\n" in arguments.course or not arguments.course.strip():
        raise UsageError("--course: expected a name of one line")
    out = arguments.out.resolve()
    refuse_inside(project, out)
    usable(out)
    with console.status("starting") as status:
        say = progress(console, status)
        kit = build_kit(project, say)
        steps = first_steps(arguments.steps, kit.steps)

        def leaks(folder: Path, history: Path) -> bool:
            told = [_tell(console, find_leaks(secrets, folder)), _tell(console, leaks_in_history(secrets, history))]
            if told[1]:
                console.print(escape(f"{history}: its history tells this for good; name a new folder with --out"))
            return any(told)

        written = release(kit, steps, arguments.course.strip(), out, leaks, say)
    if not written:
        console.print("Nothing was written.")
        return 1
    told = f"{count(len(steps), 'step')}, no solution in any file: {arguments.out}"
    console.print(escape(told), highlight=False, soft_wrap=True)
    return 0
