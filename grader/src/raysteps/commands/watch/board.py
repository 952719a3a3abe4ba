"""What the page shows, as JSON; whoever serves a page waits here for the next state."""

import json
import threading
from typing import Any

State = dict[str, Any]


class Board:
    """Holds the newest state only: a page that was slow misses what was before."""

    def __init__(self, state: State) -> None:
        self._changed = threading.Condition()
        self._version = 1
        self._text = _as_line(state)
        self._state = state
        self._closed = False

    @property
    def is_closed(self) -> bool:
        return self._closed

    def show(self, state: State) -> None:
        with self._changed:
            self._put(state)

    def _put(self, state: State) -> None:
        self._state = state
        self._text = _as_line(state)
        self._version += 1
        self._changed.notify_all()

    def now(self) -> tuple[int, str]:
        """The version and the state, in one line."""
        with self._changed:
            return self._version, self._text

    def wait(self, seen: int, seconds: float) -> tuple[int, str] | None:
        """What is newer than the version that was seen; None when there is nothing after that time."""
        with self._changed:
            if self._changed.wait_for(lambda: self._version != seen, seconds):
                return self._version, self._text
            return None

    def close(self) -> None:
        """The last state: nobody watches any more."""
        with self._changed:
            if not self._closed:
                self._closed = True
                self._put(self._state | {"over": True})


def _as_line(state: State) -> str:
    return json.dumps(state, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
