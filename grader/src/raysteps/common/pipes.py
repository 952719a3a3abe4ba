"""Reads what a program says, on every system and without waiting for it."""

import os
import threading
from typing import IO

_PIECE = 1 << 16


class PipeReader:
    """A thread that reads a pipe to its end and keeps the first `cap` bytes. The pipe is its own, to close it as well:
    somebody who outlives the program may hold the other end for long."""

    def __init__(self, pipe: IO[bytes] | None, cap: int) -> None:
        assert pipe is not None
        self._pipe = pipe
        self._cap = cap
        self._kept = bytearray()
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def _read(self) -> None:
        with self._pipe:
            while data := os.read(self._pipe.fileno(), _PIECE):
                self._kept += data[: max(0, self._cap - len(self._kept))]

    def is_at_end(self, seconds: float) -> bool:
        """Whether the pipe was closed at the other end, within that time."""
        self._thread.join(max(0.0, seconds))
        return not self._thread.is_alive()

    def bytes(self) -> bytes:
        return bytes(self._kept)
