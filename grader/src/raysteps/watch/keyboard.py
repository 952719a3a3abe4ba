"""Single keys from the terminal: what counts as one, and where they are to be had."""

import importlib
import os
import re
import select
import signal
import sys
import threading
import time
from contextlib import suppress
from typing import Protocol

from raysteps.watch.events import Key, Post

_SEQUENCE = re.compile(r"\x1b(?:\[[0-9;?]*[ -/]*[@-~]|O.|.)?", re.DOTALL)  # arrows, function keys, Alt with a letter
_LOOK_SECONDS = 0.2
_MAX_LETTERS = 4  # that come at once; more were pasted, and by mistake


class Keyboard(Protocol):
    """Gives letters until it is closed."""

    def start(self) -> None: ...

    def close(self) -> None: ...


def letters(text: str) -> list[str]:
    """What was typed: no arrows and function keys, which come as sequences, and nothing pasted."""
    text = _SEQUENCE.sub("", text)
    if len(text) > _MAX_LETTERS:
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


# Modules that only some systems have are imported by their names: type checkers on others do not know them.


def in_foreground() -> bool:
    """A job in the background must not touch the terminal: it would be stopped."""
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except (OSError, AttributeError, ValueError):
        return False


class UnixKeyboard(KeyListener):
    """The terminal is as it was when all is over."""

    def __init__(self, post: Post) -> None:
        super().__init__(post)
        self._termios, self._tty = importlib.import_module("termios"), importlib.import_module("tty")
        self._terminal = sys.stdin.fileno()
        self._before = self._termios.tcgetattr(self._terminal)

    def _take(self) -> None:
        if not self._end.is_set() and in_foreground():
            self._tty.setcbreak(self._terminal)

    def _give_back(self) -> None:
        if in_foreground():
            with suppress(self._termios.error):
                self._termios.tcsetattr(self._terminal, self._termios.TCSADRAIN, self._before)

    def _read(self) -> str | None:
        ready, _, _ = select.select([self._terminal], [], [], _LOOK_SECONDS)
        if not ready:
            return ""
        with suppress(OSError):
            data = os.read(self._terminal, 1024)
            return data.decode("utf-8", "ignore") if data else None
        return None

    def start(self) -> None:
        super().start()
        signal.signal(signal.SIGCONT, lambda *_: self._take())  # after Ctrl-Z and fg

    def close(self) -> None:
        signal.signal(signal.SIGCONT, signal.SIG_DFL)
        super().close()


class WindowsKeyboard(KeyListener):
    """The console gives single keys without being asked to."""

    def __init__(self, post: Post) -> None:
        super().__init__(post)
        self._console = importlib.import_module("msvcrt")

    def _read(self) -> str | None:
        end = time.monotonic() + _LOOK_SECONDS
        while not self._console.kbhit():
            if time.monotonic() > end:
                return ""
            time.sleep(0.02)
        letter: str = self._console.getwch()
        if letter in ("\x00", "\xe0"):  # an arrow or a function key: its name follows
            self._console.getwch()
            return ""
        return letter


class NoKeyboard:
    """Where stdin is no terminal."""

    def start(self) -> None:
        pass

    def close(self) -> None:
        pass


def find_keyboard(post: Post) -> Keyboard:
    """The terminal's, when stdin is one and this is no job in the background; Windows has no termios."""
    if sys.stdin is None or not sys.stdin.isatty():
        return NoKeyboard()
    with suppress(ImportError):
        keyboard = UnixKeyboard(post)
        return keyboard if in_foreground() else NoKeyboard()
    with suppress(ImportError):
        return WindowsKeyboard(post)
    return NoKeyboard()
