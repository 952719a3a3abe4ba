"""Keys from a Windows console."""

import importlib
import time
from collections.abc import Callable

from raysteps.watch.keyboard import LOOK_SECONDS, KeyListener

_console = importlib.import_module("msvcrt")  # by its name: type checkers on other systems do not know it
_is_hit: Callable[[], bool] = _console.kbhit
_get: Callable[[], str] = _console.getwch


class WindowsKeyboard(KeyListener):
    """The console gives single keys without being asked to."""

    def _read(self) -> str | None:
        end = time.monotonic() + LOOK_SECONDS
        while not _is_hit():
            if time.monotonic() > end:
                return ""
            time.sleep(0.02)
        letter = _get()
        if letter in ("\x00", "\xe0"):  # an arrow or a function key: its name follows
            _get()
            return ""
        return letter
