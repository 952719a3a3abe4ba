"""The command `watch`."""

import argparse
import queue
from collections.abc import Sequence
from contextlib import ExitStack

from rich.console import Console

from raysteps.cli import port
from raysteps.cli.steps import STEP_NAMES
from raysteps.common.local_server import end_as_interrupted, on_a_desktop, shown_in_browser
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.progress.standing import chosen_or_next
from raysteps.watch.events import Event
from raysteps.watch.file_watcher import FileWatcher, why_poll
from raysteps.watch.keyboard import find_keyboard
from raysteps.watch.page_state import PageServer, PageState, page_of, state_of
from raysteps.watch.runner import INSPECT, WORKER, Inspection, Runner
from raysteps.watch.session import Session
from raysteps.watch.step_view import StepView
from raysteps.watch.terminal_view import TerminalView

_INTERRUPTED = 130


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("step", nargs="?", metavar="STEP", help=f"{STEP_NAMES}; the next one when none is given")
    parser.add_argument(
        "--open",
        "--browser",
        dest="browser",
        action=argparse.BooleanOptionalAction,
        help="open the page in a browser (on a desktop)",
    )
    parser.add_argument("--poll", action="store_true", help="look for saves every moment, where events do not work")
    parser.add_argument("--quick", action="store_true", help="never check hidden cases by itself")
    parser.add_argument("--port", type=port, default=0, metavar="N", help="of the page (any that is free)")


def _watch(
    project: Project, step: Step, arguments: argparse.Namespace, showing: TerminalView,
    worker: Sequence[str], program: Sequence[str],
) -> None:  # fmt: skip
    events: queue.Queue[Event] = queue.Queue()
    why = "--poll" if arguments.poll else why_poll(project.steps)
    with ExitStack() as stack:
        board = PageState(state_of(StepView(step)))
        server = PageServer(board, page_of, arguments.port)
        stack.callback(server.close)
        runner = Runner(project, events.put, worker)
        stack.callback(runner.close)
        saves = FileWatcher(project, step, events.put, poll=bool(why))
        stack.callback(saves.close)
        inspection = Inspection(project, events.put, program)
        stack.callback(inspection.stop)
        keyboard = find_keyboard(events.put)
        stack.callback(keyboard.close)
        saves.start()
        keyboard.start()
        showing.console.print(f"Page: {server.address}", highlight=False, soft_wrap=True)
        if why:
            showing.dim(f"Files are polled: {why}.")
        if on_a_desktop() if arguments.browser is None else arguments.browser:
            stack.enter_context(shown_in_browser(server.address))
        session = Session(
            project, step, events, runner, saves, keyboard, inspection, board, showing, checks=not arguments.quick
        )
        session.run()


def run(
    project: Project, arguments: argparse.Namespace, console: Console,
    worker: Sequence[str] = WORKER, program: Sequence[str] = INSPECT,
) -> int:  # fmt: skip
    """Watches until somebody quits. `worker` does the jobs, and `program` looks into pixels."""
    step = chosen_or_next(project, arguments.step)
    showing = TerminalView(console)
    if step is None:
        showing.line("All steps are done. Name the one that you want to watch, such as: ./raysteps watch 03")
        return 0
    end_as_interrupted()
    try:
        _watch(project, step, arguments, showing, worker, program)
    except KeyboardInterrupt:
        showing.command("\nStopped watching.")
        return _INTERRUPTED
    showing.line("Stopped watching.")
    return 0
