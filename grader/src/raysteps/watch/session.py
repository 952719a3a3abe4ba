"""The loop: saves and keys come in, runs are started and stopped, and what they say is shown."""

import queue
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from raysteps.common.errors import RaystepsError, reason_and_place
from raysteps.common.platform import kit_command
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.progress.hints import Hints, no_other
from raysteps.progress.reset import lost_lines, own_file, print_done, print_loss, put_back
from raysteps.progress.standing import next_of, own_source, print_list, shown, standings
from raysteps.report.wording import inspect_worst
from raysteps.submission.entries import RejectedFile
from raysteps.watch.events import (
    Event,
    FileSaved,
    FileVanished,
    InspectEnded,
    Key,
    Owner,
    WatchNotice,
    WorkerEnded,
    WorkerLine,
    WorkerMessage,
)
from raysteps.watch.file_watcher import FileWatcher
from raysteps.watch.keyboard import Keyboard, NoKeyboard
from raysteps.watch.page_state import PageState, state_of
from raysteps.watch.runner import Inspection, Runner
from raysteps.watch.step_view import StepView, edited_functions
from raysteps.watch.terminal_view import TerminalView


def command_of_worst(view: StepView) -> list[str] | None:
    """Of the first picture that is wrong."""
    if view.result is None or view.out is None:
        return None
    found = (inspect_worst(view.step, image, view.out) for image in view.result.images)
    return next(filter(None, found), None)


# What the keys do.


class Actions:
    """One method for each key. A question turns the next key into its answer."""

    def __init__(self, session: "Session") -> None:
        self._session = session
        self._question: Callable[[], None] | None = None
        self._keys: dict[str, Callable[[], None]] = {
            "h": self._hint,
            "n": self._next,
            "l": self._list,
            "i": self._inspect,
            "c": self._check,
            "r": self._reset,
            " ": lambda: session.look("once more"),
            "?": session.showing.help,
            "q": self._quit,
        }

    def press(self, letter: str) -> None:
        """A key that means nothing does nothing. What goes wrong is told, and the loop goes on."""
        question, self._question = self._question, None
        try:
            if question is not None:
                if letter.lower() == "y":
                    question()
                else:
                    self._session.showing.line("Nothing was changed.")
            elif letter in self._keys:
                self._keys[letter]()
        except (RaystepsError, OSError) as error:
            self._session.showing.line(reason_and_place(error), "red")

    def remind(self) -> None:
        """Of the keys, where there are any."""
        if not isinstance(self._session.keyboard, NoKeyboard):
            self._session.showing.keys()

    def _quit(self) -> None:
        self._session.over = True

    def _hint(self) -> None:
        session, step = self._session, self._session.view.step
        hint = Hints(session.project).following(step)
        if hint is None:
            for line in no_other(step).splitlines():
                session.showing.line(line)
            return
        session.showing.line(f"hint {hint.level} of {hint.of}", "bold")
        for line in hint.text.splitlines():
            session.showing.line(f"  {line}")
        session.showing.dim(hint.left)
        session.view.hints = [other for other in session.view.hints if other.level != hint.level] + [hint]
        session.show()

    def _next(self) -> None:
        session = self._session
        step = next_of(standings(session.project), after=session.view.step)
        if step is None:
            session.showing.line("There is no other step that is not done.")
        else:
            session.go_to(step)

    def _list(self) -> None:
        project = self._session.project
        print_list(project, self._session.showing.console, standings(project), self._session.view.step)

    def _check(self) -> None:
        session = self._session
        if session.view.phase == "checking":
            session.showing.dim("it is being checked already")
        elif session.view.phase == "looking":
            session.showing.dim("it will be checked as soon as it is built")
            session.check_after_look = True
        else:
            session.check()

    def _inspect(self) -> None:
        session = self._session
        words = command_of_worst(session.view)
        if words is None:
            session.showing.line("No picture is wrong (or there is none yet): nothing to look into.")
        else:
            session.showing.command(kit_command(*words), "bold")
            session.inspection.start(words)

    def _reset(self) -> None:
        session, step = self._session, self._session.view.step
        name = shown(session.project, step, step.file)
        lost = lost_lines(session.project, step)
        if lost is None and own_file(session.project, step).is_file():
            session.showing.line(f"{name} is the stub already.")
            return

        def put() -> None:
            print_done(session.showing.console, name, put_back(session.project, step))

        if lost is None:
            put()
            return
        print_loss(session.showing.console, lost, name)
        session.showing.line("Put the stub back? Press y; any other key leaves it as it is.", "bold")
        self._question = put


def _what_changed(name: str, owner: Owner) -> str:
    return f"{name} changed, the kit is built again" if owner == "kit" else f"{name} saved"


_IDLE_SECONDS = 0.5  # after a look, until the full check begins by itself; a save stops it
_TICK_SECONDS = 0.2


class Session:
    """Everything happens in the thread that calls `run`; the others only post events."""

    def __init__(
        self, project: Project, step: Step, events: "queue.Queue[Event]", runner: Runner, saves: FileWatcher,
        keyboard: Keyboard, inspection: Inspection, board: PageState, showing: TerminalView, *, checks: bool,
    ) -> None:  # fmt: skip
        self.project = project
        self.view = StepView(step)
        self.showing = showing
        self.keyboard = keyboard
        self.inspection = inspection
        self.saves = saves
        self._events = events
        self._runner = runner
        self._board = board
        self._checks = checks
        self._check_at: float | None = None
        self.check_after_look = False
        self._began = 0.0
        self._actions = Actions(self)
        self._held: deque[Event] = deque()  # what workers tell while a pixel is looked into: one speaks at a time
        self._source = self._own_source()
        self.over = False

    def _own_source(self) -> str:
        """Nothing where it cannot be read: the worker says why."""
        with suppress(OSError, RejectedFile):
            return (own_source(self.project, self.view.step) or b"").decode("utf-8", "replace")
        return ""

    def run(self) -> None:
        """Until somebody quits."""
        self.look("watching")
        while not self.over:
            with suppress(queue.Empty):
                self._handle(self._events.get(timeout=_TICK_SECONDS))
                continue
            if self._check_at is not None and not self.inspection.is_running and time.monotonic() >= self._check_at:
                self.check()

    def show(self) -> None:
        """Brings the page up to date."""
        self._board.show(state_of(self.view))

    def look(self, why: str) -> None:
        """Builds, tests and draws. Whatever ran is stopped: it was about code that is no more."""
        self._check_at = None
        self._began = time.monotonic()
        self._note_edit()
        self.view = StepView(
            self.view.step, saved=f"{datetime.now():%H:%M:%S}", hints=self.view.hints, edited=self.view.edited
        )
        self.showing.begin(self.view, why)
        self._runner.start("look", self.view.step)
        self.show()

    def _note_edit(self) -> None:
        """An edit of no function, such as of a helper, leaves it at the one before."""
        before, self._source = self._source, self._own_source()
        self.view.edited = edited_functions(before, self._source, self.view.step) or self.view.edited

    def check(self) -> None:
        """All of the step: when nothing was saved for a while, or when somebody asks for it."""
        self._check_at = None
        self.view.phase, self.view.said = "checking", ""
        if self.view.result is not None and not self.view.full:
            self.view.looked = tuple(self.view.result.tests)
        hidden = ", hidden cases too" if self.project.has_reference else ""
        self.showing.dim(f"checking all of it{hidden}; a save stops it")
        self._runner.start("check", self.view.step)
        self.show()

    def go_to(self, step: Step) -> None:
        self._runner.stop()
        self.check_after_look = False
        self.saves.look_at(step)
        self.view = StepView(step)
        self._source = self._own_source()
        self.look("watching")

    def _handle(self, event: Event) -> None:
        """A save and a key come first: they end a look into a pixel."""
        match event:
            case FileSaved(name, owner):
                self.inspection.stop()
                self._held.clear()
                self.look(_what_changed(name, owner))
            case FileVanished():
                self._vanished()
            case WatchNotice(text):
                self.showing.dim(text)
            case Key(letter):
                self.inspection.stop()
                self._tell_held()
                self._actions.press(letter)
            case InspectEnded(run):
                if self.inspection.ended(run):
                    self._tell_held()
                    self._actions.remind()
            case WorkerMessage() | WorkerEnded() if self.inspection.is_running:
                self._held.append(event)
            case WorkerMessage(run, line) if run == self._runner.run:
                self._told(line)
            case WorkerEnded(run, code, errors) if run == self._runner.run:
                self._ended(code, errors)

    def _tell_held(self) -> None:
        held, self._held = self._held, deque()
        for event in held:
            self._handle(event)

    def _vanished(self) -> None:
        self._runner.stop()
        self.inspection.stop()
        self._held.clear()
        self._check_at, self.check_after_look = None, False
        self.view = StepView(self.view.step, "idle", saved=self.view.saved, gone=True, hints=self.view.hints)
        self.showing.result(self.view)
        self.show()

    def _told(self, line: WorkerLine) -> None:
        view = self.view
        if line.say:
            view.said = line.say
            self.showing.dim(f"{view.said} …")
        if line.error:
            view.problem = line.error
        if line.result is not None:
            view.result, view.out = line.result, Path(line.out)
            view.complete, view.full = line.complete, view.phase == "checking"
            if view.complete and not view.full:
                view.seconds = round(time.monotonic() - self._began, 1)
            if view.is_done:
                view.following = next_of(standings(self.project), after=view.step)
        self.show()

    def _ended(self, code: int, errors: str) -> None:
        self._runner.finished()
        view = self.view
        was_check = view.phase == "checking"
        if not view.problem and (not view.complete or view.full != was_check):
            last = errors.rpartition("\n")[2]
            view.problem = f"This run ended before it was done (exit code {code}){': ' + last if last else '.'}"
        view.phase, view.said = "idle", ""
        self.showing.result(view)
        self.show()
        asked, self.check_after_look = self.check_after_look, False
        goes_on = not was_check and view.can_be_checked and (self._checks or asked)
        if goes_on and view.hung and not asked:
            self.showing.dim("what hangs would hang again: press c to check all of it nevertheless")
            self._actions.remind()
        elif goes_on:
            self._check_at = time.monotonic() + (0 if asked else _IDLE_SECONDS)
        else:
            self._actions.remind()
