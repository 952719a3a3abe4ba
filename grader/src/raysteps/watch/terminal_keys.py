"""Keys from a Unix terminal."""

import os
import select
import signal
import sys
import termios
import tty
from contextlib import suppress

from raysteps.watch.events import Post
from raysteps.watch.keyboard import LOOK_SECONDS, KeyListener


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
