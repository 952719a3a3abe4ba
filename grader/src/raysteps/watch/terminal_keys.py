"""Keys from a Unix terminal."""

import os
import select
import signal
import sys
import termios
import threading
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from raysteps.watch.events import Key, Post
from raysteps.watch.keyboard import letters

# A thread that reads keys, and leaves the terminal alone for as long as somebody else needs it.

LOOK_SECONDS = 0.2


class KeyListener:
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
                time.sleep(LOOK_SECONDS / 10)
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


def in_front() -> bool:
    """A job in the background must not touch the terminal: it would be stopped."""
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except (OSError, AttributeError, ValueError):
        return False


class UnixKeyboard(KeyListener):
    """The terminal is as it was when all is over."""

    def __init__(self, post: Post) -> None:
        super().__init__(post)
        self._terminal = sys.stdin.fileno()
        self._before = termios.tcgetattr(self._terminal)

    def _take(self) -> None:
        if not self._end.is_set() and in_front():
            tty.setcbreak(self._terminal)

    def _give_back(self) -> None:
        if in_front():
            with suppress(termios.error):
                termios.tcsetattr(self._terminal, termios.TCSADRAIN, self._before)

    def _read(self) -> str | None:
        ready, _, _ = select.select([self._terminal], [], [], LOOK_SECONDS)
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
