"""A screen that nobody sees, for programs that want a window."""

import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager

from raysteps.common.errors import GraderFault

_SECONDS = 60


class NoScreen(Exception):
    """Xvfb is missing."""


@contextmanager
def hidden_screen() -> Iterator[dict[str, str]]:
    """The environment of a program that is to be shown there."""
    if shutil.which("Xvfb") is None:
        raise NoScreen("Xvfb is missing: install xvfb")
    reading, writing = os.pipe()
    with os.fdopen(reading) as pipe:
        try:
            command = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "800x600x24", "-nolisten", "tcp"]
            server = subprocess.Popen(command, pass_fds=[writing], stderr=subprocess.DEVNULL)
        except OSError as error:
            raise GraderFault(f"Xvfb does not start: {error}") from error
        finally:
            os.close(writing)
        try:
            number = pipe.readline().strip()
            if not number:
                raise GraderFault("Xvfb does not start: it names no screen; `Xvfb :99` says why")
            yield {**os.environ, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"}
        finally:
            server.terminate()
            server.wait(_SECONDS)
