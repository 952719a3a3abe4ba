"""The command `play`."""

import argparse
import sys
import threading
from contextlib import ExitStack, suppress
from pathlib import Path

from rich.console import Console

from raysteps.cli import port
from raysteps.common.errors import UsageError
from raysteps.common.local_server import end_as_interrupted, on_a_desktop, shown_in_browser
from raysteps.course.project import Project
from raysteps.play.packages import REGISTRY, registry_of
from raysteps.play.play_page import PlayPage, PlayServer, publish, refuse_to_publish

_PORT = 8471  # a browser keeps what it is given by this number, too: it has to be the same every time


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What may follow `play`."""
    add = parser.add_argument
    add("--port", type=port, default=_PORT, metavar="N", help=f"of the page ({_PORT}); your work is kept by it")
    add("--no-open", "--no-browser", action="store_true", help="do not open the page in a browser")
    add("--registry", metavar="URL", help=f"where npm packages are loaded down from, once ({REGISTRY})")
    add(
        "--out",
        type=Path,
        metavar="DIR",
        help="write the page to be published: a new or empty folder, or an earlier page",
    )


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Makes the page, and serves it until somebody ends it, or writes it where it is to be published."""

    def say(text: str) -> None:
        console.print(text, highlight=False, markup=False, soft_wrap=True)
        sys.stdout.flush()

    end_as_interrupted()
    if arguments.out is not None:
        refuse_to_publish(project, arguments.out)  # before the page is made, which may take minutes
        publish(PlayPage(project, registry_of(arguments.registry), say).make(), arguments.out)
        say(f"The page is in {arguments.out}. Put this folder on any web space.")
        return 0
    try:
        server = PlayServer(port=arguments.port)  # before the page is made, which may take minutes
    except UsageError as error:
        raise UsageError(f"{error}. What you write on the page is kept by its port") from error
    try:
        folder = PlayPage(project, registry_of(arguments.registry), say).make()
        with suppress(KeyboardInterrupt), ExitStack() as stack:
            server.folder = folder
            say(f"Page: {server.address}")
            say(f"Its files: {folder}")
            say("Ctrl-C ends it. What you write on the page is kept in your browser.")
            if not arguments.no_open and on_a_desktop():
                stack.enter_context(shown_in_browser(server.address))
            threading.Event().wait()
    finally:
        server.close()
    return 0
