"""The loop: saves and keys come in, runs are started and stopped, and what they say is shown."""

import queue
import time
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import Any

from raysteps.commands.watch.actions import Actions
from raysteps.commands.watch.board import Board
from raysteps.commands.watch.events import Ended, Event, Key, Noticed, Saved, Told, Vanished
from raysteps.commands.watch.keys import Keyboard
from raysteps.commands.watch.page import state_of
from raysteps.commands.watch.runner import Runner
from raysteps.commands.watch.saves import Saves
from raysteps.commands.watch.showing import Showing
from raysteps.commands.watch.view import View
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project

_IDLE_SECONDS = 2.0  # after a look, until the full check begins by itself
_TICK_SECONDS = 0.2


class Session:
    """Everything happens in the thread that calls `run`; the others only post events."""

    def __init__(
        self, project: Project, step: Step, events: "queue.Queue[Event]", runner: Runner, saves: Saves,
        keyboard: Keyboard, board: Board, showing: Showing, *, checks: bool,
    ) -> None:  # fmt: skip
        self.project = project
        self.view = View(step)
        self.showing = showing
        self.keyboard = keyboard
        self.saves = saves
        self._events = events
        self._runner = runner
        self._board = board
        self._checks = checks
        self._check_at: float | None = None
        self.check_after_look = False
        self._began = 0.0
        self._actions = Actions(self)
        self.over = False

    def run(self) -> None:
        """Until somebody quits."""
        self.look("watching")
        while not self.over:
            with suppress(queue.Empty):
                self._handle(self._events.get(timeout=_TICK_SECONDS))
                continue
            if self._check_at is not None and time.monotonic() >= self._check_at:
                self.check()

    def show(self) -> None:
        """Brings the page up to date."""
        self._board.show(state_of(self.view))

    def look(self, why: str) -> None:
        """Builds, tests and draws. Whatever ran is stopped: it was about code that is no more."""
        self._check_at = None
        self._began = time.monotonic()
        self.view = View(self.view.step, saved=f"{datetime.now():%H:%M:%S}", hints=self.view.hints)
        self.showing.begin(self.view, why)
        self._runner.start("look", self.view.step)
        self.show()

    def check(self) -> None:
        """All of the step: when nothing was saved for a while, or when somebody asks for it."""
        self._check_at = None
        self.view.phase, self.view.said = "checking", ""
        hidden = ", hidden cases too" if self.project.has_reference else ""
        self.showing.dim(f"checking all of it{hidden}; a save stops it")
        self._runner.start("check", self.view.step)
        self.show()

    def go_to(self, step: Step) -> None:
        self._runner.stop()
        self.saves.look_at(step)
        self.view = View(step)
        self.look("watching")

    def _handle(self, event: Event) -> None:
        match event:
            case Saved(name, own):
                self.look(f"{name} saved" if own else f"{name} changed, the kit is built again")
            case Vanished():
                self._vanished()
            case Noticed(text):
                self.showing.dim(text)
            case Key(letter):
                self._actions.press(letter)
            case Told(run, words) if run == self._runner.run:
                self._told(words)
            case Ended(run, code, errors) if run == self._runner.run:
                self._ended(code, errors)

    def _vanished(self) -> None:
        self._runner.stop()
        self._check_at = None
        self.view = View(self.view.step, "idle", saved=self.view.saved, gone=True, hints=self.view.hints)
        self.showing.result(self.view)
        self.show()

    def _told(self, words: dict[str, Any]) -> None:
        view = self.view
        if "say" in words:
            view.said = str(words["say"])
            self.showing.dim(f"{view.said} …")
        if "error" in words:
            view.problem = str(words["error"])
        if "result" in words:
            view.result, view.out = words["result"], Path(words["out"])
            view.complete, view.full = bool(words["complete"]), view.phase == "checking"
            if view.complete and not view.full:
                view.seconds = round(time.monotonic() - self._began, 1)
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
        if not was_check and view.can_be_checked and (self._checks or asked):
            self._check_at = time.monotonic() + (0 if asked else _IDLE_SECONDS)
        else:
            self._actions.remind()
