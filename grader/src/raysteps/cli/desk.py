"""The command `desk`."""

import argparse
import getpass
import sys
import threading
from contextlib import ExitStack, closing, suppress
from pathlib import Path

from rich.console import Console

from raysteps.classroom.database import FILE, ClassDatabase, explained_sqlite_errors
from raysteps.classroom.session import undisturbed
from raysteps.cli import port
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.local_server import end_as_interrupted, on_a_desktop, shown_in_browser
from raysteps.common.platform import kit_command, refuse_on_windows
from raysteps.common.text import count, print_plain
from raysteps.course.project import Project
from raysteps.desk.annotation_files import export_file, import_file
from raysteps.desk.desk import Desk, DeskServer
from raysteps.desk.file_writer import check_folder, write_all


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What may follow `desk`."""
    add = parser.add_argument
    add("folder", type=Path, metavar="OUT", help="the --out folder of grade-class")
    add("--as", dest="author", default="", metavar="NAME", help="who you are (your login); students read it")
    add("--port", type=port, default=0, metavar="N", help="of the page (any that is free)")
    add("--no-open", "--no-browser", action="store_true", help="do not open the page in a browser")
    add(
        "--export",
        type=Path,
        metavar="FILE",
        help="write all that was said (.json, with its history, or .csv), and end",
    )
    add(
        "--import", dest="taken", type=Path, metavar="FILE", help="take in such a file, or a table of requests, and end"
    )
    add("--write", action="store_true", help="make the files of the class anew with all that was said, and end")


def _login() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # a number that has no name here
        return ""


def _anew(out: Path) -> str:
    return kit_command("desk", out, "--write")


def _busy(out: Path) -> str:
    """A grade-class writes what was said at its end; a sending, or a nightly that only looks, does not."""
    return f"something else is at work there. When it has ended, {_anew(out)} makes the files anew."


def _serve(console: Console, out: Path, arguments: argparse.Namespace) -> int:
    desk = Desk(out, arguments.author or _login())
    try:
        server = DeskServer(desk, arguments.port)
        try:
            with suppress(KeyboardInterrupt), ExitStack() as stack:
                print_plain(console, f"Page: {server.address}")
                console.print("Ctrl-C ends it. All that you say is kept at once.", highlight=False)
                sys.stdout.flush()
                if not arguments.no_open and on_a_desktop():
                    stack.enter_context(shown_in_browser(server.address))
                threading.Event().wait()
        finally:
            with undisturbed():
                server.close()
    finally:
        with undisturbed():
            desk.close()
    told = {
        "written": "All files hold what was said.",
        "waiting": f"What you said is kept, and the files wait: {_busy(out)}",
        "writing": f"Some files may not hold what was said last. It is kept; {_anew(out)} makes them anew.",
        "failed": f"The files could not be written: {desk.writer.trouble}. What you said is kept; {_anew(out)} makes "
        "them anew.",
    }
    console.print(told[desk.writer.state], highlight=False, markup=False, soft_wrap=True)
    return GraderFault.exit_code if desk.writer.state == "failed" else 0


def _exchange(console: Console, out: Path, arguments: argparse.Namespace) -> int:
    check_folder(out)
    with explained_sqlite_errors(out / FILE, "used"), closing(ClassDatabase(out)) as database:
        if arguments.taken:
            new = import_file(database, arguments.taken, arguments.author or _login())
            rows = f"{count(new, 'row')} taken in that the class did not have (comments, points, requests and the like)"
            told = rows if new else "nothing is new: the class has all of it"
            console.print(f"{arguments.taken}: {told}", highlight=False, markup=False, soft_wrap=True)
        if arguments.export:
            amount = export_file(database, arguments.export)
            console.print(
                f"{arguments.export}: {count(amount, 'row')} written", highlight=False, markup=False, soft_wrap=True
            )
    if arguments.taken and not write_all(out):
        console.print(f"The files wait: {_busy(out)}", highlight=False, markup=False, soft_wrap=True)
    return 0


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Serves the page until somebody ends it."""
    refuse_on_windows("desk")
    out: Path = arguments.folder
    if arguments.export or arguments.taken:
        return _exchange(console, out, arguments)
    if arguments.write:
        if not write_all(out):
            raise UsageError(f"{out}: {_busy(out).removesuffix('.')}")
        console.print(f"Written: {out}", highlight=False, markup=False, soft_wrap=True)
        return 0
    end_as_interrupted()
    return _serve(console, out, arguments)
