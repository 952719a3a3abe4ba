"""Reads what a task wrote."""

import os
import stat
from pathlib import Path

from raysteps.common.files import open_regular

_MEGABYTE = 1 << 20


def read_regular(path: Path, cap: int) -> bytes | None:
    """The bytes of a file that a task wrote: no link is followed, no pipe is waited for."""
    try:
        file = open_regular(path)
    except OSError:
        return None
    with os.fdopen(file, "rb", buffering=0) as opened:
        if not stat.S_ISREG(os.fstat(file).st_mode):
            return None
        data = bytearray()
        while len(data) < cap and (part := opened.read(min(_MEGABYTE, cap - len(data)))):
            data += part
        return bytes(data) or None
