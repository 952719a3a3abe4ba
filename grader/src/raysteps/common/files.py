"""Writes files so that nobody ever sees half of one."""

import fcntl
import json
import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from raysteps.common.errors import UsageError


def usable_folder(path: Path) -> None:
    """Makes the folder that somebody named for results, or says that it cannot be written to."""
    try:
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    except OSError as error:
        raise UsageError(f"{path}: results cannot be written there: {error.strerror or error}") from error


@contextmanager
def one_at_a_time(lock: Path) -> Iterator[None]:
    """Waits until nobody else holds the lock."""
    lock.parent.mkdir(parents=True, exist_ok=True)
    with lock.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def write_bytes(path: Path, data: bytes) -> None:
    """Writes to a temporary name in the same folder, then renames."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        temporary.chmod(0o644)
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def forget_unfinished(folder: Path) -> None:
    """Removes what write_bytes left in the folder when it was killed. Only where nobody else is writing."""
    for path in folder.glob(".*.*"):
        if re.fullmatch(r"\..+\.[a-z0-9_]{8}", path.name) and path.is_file():
            path.unlink(missing_ok=True)


def write_json(path: Path, value: Any) -> None:
    """Writes readable JSON."""
    write_bytes(path, (json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False) + "\n").encode())


def write_if_changed(path: Path, data: bytes) -> bool:
    """Leaves a file with the same content alone, so that nothing is rebuilt for it."""
    if path.is_file() and not path.is_symlink() and path.read_bytes() == data:
        return False
    write_bytes(path, data)
    return True
