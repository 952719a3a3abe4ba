"""The command `release`."""

import argparse
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import date
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import UsageError
from raysteps.common.platform import kit_command
from raysteps.common.text import count, join_and, print_plain, tenths
from raysteps.course.manifest import Step, choose, course_steps, of_other_parts, read_steps, steps_words
from raysteps.course.project import Project
from raysteps.course.settings import read_course
from raysteps.play.packages import REGISTRY, registry_of
from raysteps.play.play_page import check_published
from raysteps.release.build_release import (
    PageOptions,
    due_steps,
    first_steps,
    refuse_foreign_files,
    release,
    written_files,
)
from raysteps.release.leaks import Leak, find_leaks, leaks_in_history, not_searched
from raysteps.release.secrets import Secrets, gather
from raysteps.report.terminal import progress
from raysteps.submission.archives import DAMAGED
from raysteps.toolchain.build_kit import build_kit
from raysteps.updater.release_list import FOLDERS

_MAX_SHOWN = 20


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where to, and what of it; or what to look through."""
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--out", type=Path, metavar="DIR", help="a new or empty folder, or an earlier release")
    where.add_argument(
        "--check", type=Path, metavar="PATH", help="look for solutions in a folder or zip that is to go out"
    )
    parser.add_argument(
        "--steps", "--only", nargs="+", default=[], metavar="STEP", help="the first steps only, such as 1-4"
    )
    parser.add_argument("--course", metavar="NAME", help="for the README (that of course.toml, else Raysteps)")
    parser.add_argument(
        "--play",
        type=Path,
        metavar="DIR",
        help="write the page to work in, too: a new or empty folder, or an earlier page",
    )
    parser.add_argument("--registry", metavar="URL", help=f"where npm packages for it come from, once ({REGISTRY})")


def tell(console: Console, leaks: list[Leak]) -> bool:
    for leak in leaks[:_MAX_SHOWN]:
        console.print(f"[red]leak[/red]  {escape(str(leak))}", highlight=False, soft_wrap=True)
    if len(leaks) > _MAX_SHOWN:
        console.print(f"      and {count(len(leaks) - _MAX_SHOWN, 'more')}", highlight=False)
    return bool(leaks)


def refuse_inside(project: Project, out: Path) -> None:
    """A release among the files of the kit would be taken for a part of it, and given out with the next one."""
    root = project.root.resolve()
    if out == root or (root in out.parents and project.build.resolve() not in out.parents):
        raise UsageError(f"{out}: lies in the kit's own folder; expected one elsewhere, such as ../{out.name}")


@contextmanager
def _unpacked(place: Path) -> Iterator[Path]:
    """The folder, or what a zip holds, as a folder."""
    if place.is_dir():
        yield place
        return
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        try:
            with zipfile.ZipFile(place) as archive:
                names = archive.namelist()
                if len({name.lower() for name in names}) < len(names):
                    raise UsageError(f"{place}: holds two files of one name, so not all of it can be looked through")
                archive.extractall(folder)
        except DAMAGED as error:
            raise UsageError(f"{place}: expected the folder of a release or of a page, or a zip of one") from error
        yield Path(folder)


def check(secrets: Secrets, place: Path, console: Console) -> int:
    """0 only when all of it was searched, as all of it may be handed out."""
    with _unpacked(place) as folder:
        return _check_folder(secrets, folder, console)


def _check_folder(secrets: Secrets, folder: Path, console: Console) -> int:
    left_out = not_searched(folder)
    leaks = tell(console, find_leaks(secrets, folder, tried=True))
    if not leaks:
        console.print(f"No solution was found in {'what was searched' if left_out else 'it'}.")
    if left_out:
        print_plain(
            console,
            f"Not searched: {left_out}. Setting up and trying a kit makes these; they are no part of a release and "
            "may hold anything. Take them away and check again before you hand this folder out",
        )
    return 1 if leaks or left_out else 0


def _chosen(project: Project, names: list[str], console: Console) -> list[Step]:
    if not names:
        steps = due_steps(project, date.today())
        later = [step for step in course_steps(project) if step not in steps]
        if later:
            print_plain(
                console, f"not yet given out, by {read_course(project).place('steps')}: {join_and(steps_words(later))}"
            )
        return steps
    steps = first_steps(names, read_steps(project), others=of_other_parts(project))
    if len(choose(steps, names)) < len(steps):
        print_plain(console, f"steps {steps_words(steps)[0]}: a kit begins with step {steps[0].number}")
    return steps


def line_to_grade(steps: list[Step], course: list[Step]) -> str:
    """The line for what comes back of a kit with these steps: the others were not given out, and count nothing."""
    only = ["--only", *steps_words(steps)] if steps != course else []
    return kit_command("grade-class", "submissions", "--out", "grades", *only)


def _page(project: Project, out: Path, arguments: argparse.Namespace) -> PageOptions | None:
    """Beside the release: within it, the next one would find a folder that is not its own."""
    if arguments.play is None:
        return None
    place = arguments.play.resolve()
    refuse_inside(project, place)
    if place == out or out in place.parents or place in out.parents:
        raise UsageError(f"--play {arguments.play}: expected a folder beside the release, such as ../{out.name}-page")
    check_published(place)
    return PageOptions(place, registry_of(arguments.registry))


def write(
    project: Project,
    names: list[str],
    course_name: str | None,
    target: Path,
    console: Console,
    page: PageOptions | None = None,
) -> list[Step]:
    """The steps of the release that is now there; none where something leaks."""
    named = (read_course(project).title or "Raysteps") if course_name is None else course_name
    course = named.strip()
    if "\n" in named or not course:
        raise UsageError("--course: expected a name of one line")
    out = target.resolve()
    refuse_inside(project, out)
    refuse_foreign_files(out)
    steps = _chosen(project, names, console)
    written_files(project, steps, course)  # what may not go out is told before anything is built
    secrets = gather(project)
    with console.status("starting") as status:
        say = progress(console, status)

        def leaks(folder: Path, history: Path) -> bool:
            told = [tell(console, find_leaks(secrets, folder)), tell(console, leaks_in_history(secrets, history))]
            if told[1]:
                console.print(escape(f"{history}: its history tells this for good; name a new folder with --out"))
            return any(told)

        written = release(build_kit(project, say), steps, course, out, leaks, say, page)
    if not written:
        console.print("Nothing was written.")
        return []
    print_plain(console, f"{count(len(steps), 'step')}, no solution in any file of the release: {target}")
    return steps


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when nothing leaks, else 1."""
    if not project.has_reference:
        raise UsageError("a students' kit cannot be released; expected the whole kit, with solutions/")
    if arguments.check is not None:
        return check(gather(project), arguments.check, console)
    out = arguments.out.resolve()
    page = _page(project, out, arguments)
    steps = write(project, arguments.steps, arguments.course, arguments.out, console, page)
    if not steps:
        return 1
    if page:
        print_plain(
            console, f"The page to work in, with the same steps: {arguments.play}. Put this folder on any web space."
        )
    worth = tenths(sum(step.points for step in steps if not step.bonus))
    bonus = tenths(sum(step.points for step in steps if step.bonus))
    more = f" and up to {bonus} more as a bonus" if any(step.bonus for step in steps) else ""
    print_plain(
        console, f"Grade what comes back, of {worth} points{more}: {line_to_grade(steps, course_steps(project))}"
    )
    kept = [name for name in FOLDERS if (out / name).is_dir()]
    if kept:
        print_plain(console, f"Kept from before, and not searched: {join_and(kept)}")
    return 0
