"""A screen that nobody sees, for programs that want a window."""

import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager

_SECONDS = 60


class NoScreen(Exception):
    """Xvfb is missing, or does not start."""


@contextmanager
def hidden_screen() -> Iterator[dict[str, str]]:
    """The environment of a program that is to be shown there."""
    if shutil.which("Xvfb") is None:
        raise NoScreen("Xvfb is missing: install xvfb")
    reading, writing = os.pipe()
    command = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "800x600x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=[writing], stderr=subprocess.DEVNULL)
    os.close(writing)
    try:
        with os.fdopen(reading) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise NoScreen("Xvfb did not start")
        yield {**os.environ, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"}
    finally:
        server.terminate()
        server.wait(_SECONDS)
