"""Single keys from the terminal: what counts as one, and where they are to be had."""

import re
import sys
import threading
from typing import Protocol

from raysteps.watch.events import Key, Post

_SEQUENCE = re.compile(r"\x1b(?:\[[0-9;?]*[ -/]*[@-~]|O.|.)?", re.DOTALL)  # arrows, function keys, Alt with a letter
LOOK_SECONDS = 0.2
_LONGEST = 4  # letters that come at once; more were pasted, and by mistake


class Keyboard(Protocol):
    """Gives letters until it is closed."""

    def start(self) -> None: ...

    def close(self) -> None: ...


def letters(text: str) -> list[str]:
    """What was typed: no arrows and function keys, which come as sequences, and nothing pasted."""
    text = _SEQUENCE.sub("", text)
    if len(text) > _LONGEST:
        return []
    return [" " if letter in "\r\n" else letter for letter in text if letter.isprintable() or letter in "\r\n"]


class KeyListener:
    """Reads in a thread until it is told to end."""

    def __init__(self, post: Post) -> None:
        self._post = post
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._listen, daemon=True)

    def _read(self) -> str | None:
        """What was typed within a moment; None when there will be nothing any more."""
        raise NotImplementedError

    def _take(self) -> None:
        """Makes the terminal give single keys."""

    def _give_back(self) -> None:
        """Makes it what it was."""

    def _listen(self) -> None:
        while not self._end.is_set():
            text = self._read()
            if text is None:
                return
            for letter in letters(text):
                self._post(Key(letter))

    def start(self) -> None:
        self._take()
        self._thread.start()

    def close(self) -> None:
        self._end.set()
        if self._thread.is_alive():
            self._thread.join(2)
        self._give_back()


class NoKeyboard:
    """Where stdin is no terminal."""

    def start(self) -> None:
        pass

    def close(self) -> None:
        pass


def find_keyboard(post: Post) -> Keyboard:
    """The terminal's, when stdin is one. A job in the background must not touch it: it would be stopped."""
    if sys.stdin is None or not sys.stdin.isatty():
        return NoKeyboard()
    try:
        from raysteps.watch.terminal_keys import UnixKeyboard, in_front
    except ImportError:
        return _on_windows(post)
    return UnixKeyboard(post) if in_front() else NoKeyboard()


def _on_windows(post: Post) -> Keyboard:
    try:
        from raysteps.watch.windows_keys import WindowsKeyboard
    except ImportError:
        return NoKeyboard()
    return WindowsKeyboard(post)
