"""A thread that reads keys."""

import threading

from raysteps.watch.events import Key, Post
from raysteps.watch.keyboard import letters

LOOK_SECONDS = 0.2


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
