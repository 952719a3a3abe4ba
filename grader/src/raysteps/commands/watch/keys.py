"""Single keys from the terminal, on Unix and on Windows. The terminal is as it was when all is over."""

import os
import re
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from typing import Protocol

from raysteps.commands.watch.events import Key, Post

_LOOK_SECONDS = 0.2
_SEQUENCE = re.compile(r"\x1b(?:\[[0-9;?]*[ -/]*[@-~]|O.|.)?", re.DOTALL)  # arrows, function keys, Alt with a letter
_LONGEST = 4  # letters that come at once; more were pasted, and by mistake


class Keyboard(Protocol):
    """Gives letters; gives the terminal back for as long as somebody else needs it."""

    def start(self) -> None: ...

    def close(self) -> None: ...

    def lent(self) -> AbstractContextManager[None]: ...


def letters(text: str) -> list[str]:
    """What was typed: no arrows and function keys, which come as sequences, and nothing pasted."""
    text = _SEQUENCE.sub("", text)
    if len(text) > _LONGEST:
        return []
    return [" " if letter in "\r\n" else letter for letter in text if letter.isprintable() or letter in "\r\n"]


class NoKeyboard:
    """Where stdin is no terminal."""

    def start(self) -> None:
        pass

    def close(self) -> None:
        pass

    @contextmanager
    def lent(self) -> Iterator[None]:
        yield


class _Listening:
    """Reads in a thread until it is told to end."""

    def __init__(self, post: Post) -> None:
        self._post = post
        self._end = threading.Event()
        self._pause = threading.Event()
        self._paused = threading.Event()
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
            if self._pause.is_set():
                self._paused.set()
                time.sleep(_LOOK_SECONDS / 10)
                continue
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

    @contextmanager
    def lent(self) -> Iterator[None]:
        self._paused.clear()
        self._pause.set()
        if self._thread.is_alive():
            self._paused.wait(1)
        self._give_back()
        try:
            yield
        finally:
            self._take()
            self._pause.clear()


def _unix_keyboard(post: Post) -> Keyboard:
    import select
    import signal
    import termios
    import tty

    fd = sys.stdin.fileno()

    class UnixKeyboard(_Listening):
        def __init__(self) -> None:
            super().__init__(post)
            self._before = termios.tcgetattr(fd)

        def _take(self) -> None:
            if not self._end.is_set() and _in_front():
                tty.setcbreak(fd)

        def _give_back(self) -> None:
            if _in_front():
                with suppress(termios.error):
                    termios.tcsetattr(fd, termios.TCSADRAIN, self._before)

        def _read(self) -> str | None:
            ready, _, _ = select.select([fd], [], [], _LOOK_SECONDS)
            if not ready:
                return ""
            with suppress(OSError):
                data = os.read(fd, 1024)
                return data.decode("utf-8", "ignore") if data else None
            return None

        def start(self) -> None:
            super().start()
            signal.signal(signal.SIGCONT, lambda *_: self._take())  # after Ctrl-Z and fg

        def close(self) -> None:
            signal.signal(signal.SIGCONT, signal.SIG_DFL)
            super().close()

    return UnixKeyboard()


def _windows_keyboard(post: Post) -> Keyboard:
    import importlib

    console = importlib.import_module("msvcrt")
    is_hit: Callable[[], bool] = console.kbhit
    get: Callable[[], str] = console.getwch

    class WindowsKeyboard(_Listening):
        def _read(self) -> str | None:
            end = time.monotonic() + _LOOK_SECONDS
            while not is_hit():
                if time.monotonic() > end:
                    return ""
                time.sleep(0.02)
            letter = get()
            if letter in ("\x00", "\xe0"):  # an arrow or a function key: its name follows
                get()
                return ""
            return letter

    return WindowsKeyboard(post)


def _in_front() -> bool:
    """A job in the background must not touch the terminal: it would be stopped."""
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except (OSError, AttributeError, ValueError):
        return False


def find_keyboard(post: Post) -> Keyboard:
    """The terminal's, when stdin is one."""
    if sys.stdin is None or not sys.stdin.isatty():
        return NoKeyboard()
    try:
        import termios  # noqa: F401
    except ImportError:
        try:
            return _windows_keyboard(post)
        except ImportError:
            return NoKeyboard()
    return _unix_keyboard(post) if _in_front() else NoKeyboard()
