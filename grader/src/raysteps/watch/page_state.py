"""The page of `watch`: its state, its HTML, and the server that tells it news."""

import json
import re
import threading
import time
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from raysteps.common.local_server import HTML, LocalHandler, LocalServer
from raysteps.common.text import number
from raysteps.course.manifest import Step
from raysteps.course.project import here
from raysteps.images.compare import read_png
from raysteps.report.page import (
    COMPARE_SCRIPTS,
    COMPARE_STYLES,
    NotAPicture,
    data_uri,
    flip_map,
    pixel_data,
    render_page,
)
from raysteps.report.wording import HOW_SURE, inspect_command, replay_command, warnings_of, watch_command
from raysteps.results.model import Diagnosis, ImageResult
from raysteps.watch.step_view import Items, StepView, passed_of, verdict

# What the page shows, as JSON; whoever serves a page waits here for the next state.

State = dict[str, object]


class News(NamedTuple):
    """One state, and whether it is the last."""

    version: int
    text: str
    is_last: bool


class PageState:
    """Holds the newest state only: a page that was slow misses what was before."""

    def __init__(self, state: State) -> None:
        self._changed = threading.Condition()
        self._version = 1
        self._text = _as_line(state)
        self._state = state
        self._closed = False

    def show(self, state: State) -> None:
        with self._changed:
            self._put(state)

    def _put(self, state: State) -> None:
        self._state = state
        self._text = _as_line(state)
        self._version += 1
        self._changed.notify_all()

    def now(self) -> News:
        """The state, in one line of text."""
        with self._changed:
            return News(self._version, self._text, self._closed)

    def wait(self, seen: int, seconds: float) -> News | None:
        """What is newer than the version that was seen; None when there is nothing after that time."""
        with self._changed:
            if self._changed.wait_for(lambda: self._version != seen, seconds):
                return News(self._version, self._text, self._closed)
            return None

    def close(self) -> None:
        """The last state: nobody watches any more."""
        with self._changed:
            if not self._closed:
                self._closed = True
                self._put(self._state | {"over": True})


def _as_line(state: State) -> str:
    return json.dumps(state, ensure_ascii=True, allow_nan=False, separators=(",", ":"))


_NUMBERS = re.compile(r"\d+ of \d+ [a-z ]+ (failed|did not pass|lost points)\.")
_MAX_LOG = 20_000
_PHASES = {"looking": "building and testing", "checking": "checking all of it", "idle": "watching"}


def _uri(folder: Path | None, name: str | None) -> str | None:
    if folder is None or not name:
        return None
    try:
        return data_uri(folder / name)
    except NotAPicture:
        return None  # such as one that the next run has just removed


@lru_cache(maxsize=16)
def _flip(reference: bytes, mine: bytes, shape: tuple[int, ...]) -> str | None:
    one, other = (np.frombuffer(data, dtype=np.uint8).reshape(shape) for data in (reference, mine))
    found = flip_map(one, other)
    return None if found is None else pixel_data(found).src


def _flip_of(folder: Path, image: ImageResult) -> str | None:
    """Of pictures that are wrong: where all is right, or waits, there is nothing to see."""
    if image.passed or image.waits_for or not image.mine:
        return None
    try:
        names = (image.reference or "", image.mine)
        pair = [read_png(folder / name) for name in names]
    except (OSError, ValueError):
        return None
    if pair[0].shape != pair[1].shape:
        return None
    return _flip(pair[0].tobytes(), pair[1].tobytes(), pair[0].shape)


def _picture(view: StepView, image: ImageResult) -> State:
    return {
        "name": image.name,
        "scene": image.scene,
        "passed": image.passed,
        "waits": bool(image.waits_for),
        "message": image.message,
        "reference": _uri(view.out, image.reference),
        "mine": _uri(view.out, image.mine),
        "flip": _flip_of(view.out, image) if view.out is not None and view.complete else None,
        "inspect": inspect_command(image.name, view.step, has_reference=here().has_reference),
    }


def _kind(items: Items, failed: list[State]) -> State:
    passed, all_ = passed_of(items)
    waits = sum(bool(item.waits_for) and not item.passed for item in items)
    return {"passed": passed, "all": all_, "waits": waits, "failed": failed}


def _tests(view: StepView) -> State:
    failed: list[State] = [
        {
            "name": test.name,
            "message": test.message,
            "expected": test.expression,
            "actual": test.expanded,
            "place": test.location,
        }
        for test in view.failed_tests
    ]
    return _kind(view.result.tests if view.result else [], failed)


def _hidden(view: StepView) -> State:
    keys = ("name", "message", "given", "expected", "actual")
    failed: list[State] = [
        {key: getattr(item, key) for key in keys} | {"again": replay_command(item.case) if item.case else ""}
        for item in view.missed
    ]
    return _kind(view.result.hidden if view.result else [], failed)


def _diagnosis(found: Diagnosis) -> State:
    return {"word": HOW_SURE[found.kind].capitalize()} | {
        key: getattr(found, key) for key in ("title", "sees", "cause", "hint", "alike")
    }


def _messages(view: StepView) -> list[str]:
    """Those that say more than the numbers which the page shows anyway; once all is known, the compiler's, too."""
    if view.result is None:
        return []
    warnings = warnings_of(view.result) if view.complete else []
    own = [message for message in view.result.messages if not _NUMBERS.fullmatch(message)]
    return [*own, *(f"The compiler warns: {' '.join(lines)}" for lines in warnings)]


def _step(step: Step) -> State:
    return {"number": step.number, "id": step.id, "title": step.title, "points": number(step.points)}


def _next(step: Step | None) -> State | None:
    return None if step is None else _step(step) | {"command": watch_command(step.id)}


def state_of(view: StepView) -> State:
    """All that the page shows; it makes itself anew from it."""
    tone, text = verdict(view)
    result = view.result
    return {
        "step": _step(view.step),
        "file": f"steps/{view.step.path.as_posix()}",
        "phase": view.phase,
        "doing": view.said if view.said and view.phase != "idle" else _PHASES[view.phase],
        "saved": view.saved,
        "seconds": view.seconds,
        "known": result is not None,
        "complete": view.complete or view.gone or bool(view.problem),
        "full": view.full,
        "verdict": {"tone": tone, "text": text},
        "messages": _messages(view),
        "log": result.build_log[:_MAX_LOG] if result else "",
        "diagnoses": [_diagnosis(found) for found in result.diagnoses] if result else [],
        "tests": _tests(view),
        "pictures": [_picture(view, image) for image in result.images] if result else [],
        "hidden": _hidden(view),
        "hints": [{"level": hint.level, "of": hint.of, "text": hint.text} for hint in view.hints],
        "next": _next(view.following),
        "over": False,
    }


def page_of(text: str) -> str:
    """The HTML; it holds the state as it is now and goes on by itself."""
    state = json.loads(text)
    title = f"{state['step']['number']} {state['step']['title']}"
    scripts = (*COMPARE_SCRIPTS, "watch-parts", "watch")
    return render_page("watch", title, {}, scripts, (*COMPARE_STYLES, "watch"), data=state, connect=True)


# Serves the page, and tells it news.

_SIGN_OF_LIFE_SECONDS = 5.0
_FAREWELL_SECONDS = 0.5
_MAX_LISTENERS = 16

MakePage = Callable[[str], str]  # from the state, as JSON, to HTML


class PageServer(LocalServer):
    """Runs in a thread until it is closed."""

    def __init__(self, board: PageState, make_page: MakePage, port: int = 0) -> None:
        super().__init__(port, _Handler)
        self.board = board
        self.make_page = make_page
        self.listeners = threading.BoundedSemaphore(_MAX_LISTENERS)
        self.start()

    def close(self) -> None:
        """Open pages hear of it first."""
        self.board.close()
        end = time.monotonic() + _FAREWELL_SECONDS
        for _ in range(_MAX_LISTENERS):
            self.listeners.acquire(timeout=max(0.0, end - time.monotonic()))
        super().close()


class _Handler(LocalHandler):
    server: PageServer

    def get(self, rest: list[str]) -> None:
        if rest == [""]:
            self.answer(200, self.server.make_page(self.server.board.now().text), HTML)
        elif rest == ["events"]:
            self._stream()
        else:
            self.nothing()

    def _stream(self) -> None:
        """Server-sent events: the state now, and whenever it changes."""
        if not self.server.listeners.acquire(blocking=False):
            self.answer(503, "Too many pages are open.\n")
            return
        try:
            self.head(200, "text/event-stream")
            news = self.server.board.now()
            self._tell(news)
            while not news.is_last:
                news = self._wait_for_more(news.version)
                self._tell(news)
        except OSError:
            return  # the browser went away
        finally:
            self.server.listeners.release()

    def _tell(self, news: News) -> None:
        self.wfile.write(f"id: {news.version}\ndata: {news.text}\n\n".encode())
        self.wfile.flush()

    def _wait_for_more(self, version: int) -> News:
        while (found := self.server.board.wait(version, _SIGN_OF_LIFE_SECONDS)) is None:
            self.wfile.write(b": still watching\n\n")
            self.wfile.flush()
        return found
