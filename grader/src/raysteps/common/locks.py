"""Locks between processes. A lock goes with the process that holds it, however that ends."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

_LOOK_EVERY = 0.1


def try_lock(handle: int) -> bool:
    """Whether nobody else holds the lock of this open file; then it is held until the file is closed. A file system
    without locks raises OSError."""
    try:
        if sys.platform == "win32":
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):  # the second one on Windows
        return False
    return True


@contextmanager
def one_at_a_time(lock: Path) -> Iterator[None]:
    """Waits until nobody else holds the lock."""
    lock.parent.mkdir(parents=True, exist_ok=True)
    with lock.open("a") as file:
        if sys.platform == "win32":
            while not try_lock(file.fileno()):  # the waiting that Windows offers gives up after 10 seconds
                time.sleep(_LOOK_EVERY)
        else:
            fcntl.flock(file, fcntl.LOCK_EX)
        yield
