"""A screen that nobody sees, for programs that want a window."""

import os
import random
import shutil
import socket
import struct
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from raysteps.common.errors import GraderFault, reason

_SECONDS = 60
_TRIES = 8
_NUMBERS = range(200, 32000)  # far from the screens that people and `xvfb-run` use
_HELLO = struct.pack("<BxHHHHxx", ord("l"), 11, 0, 0, 0)  # how a client of X11 begins, without a key


class NoScreen(Exception):
    """Xvfb is missing."""


@contextmanager
def hidden_screen() -> Iterator[dict[str, str]]:
    """The environment of a program that is to be shown there.

    Xvfb gets a number and does not choose one: only then does it lock the number, so that no other server takes it, or
    its socket. It says when it listens, and a screen is given out when a client was let in."""
    if shutil.which("Xvfb") is None:
        raise NoScreen("Xvfb is missing: install xvfb")
    for number in random.sample(_NUMBERS, _TRIES):
        server = _started(number)
        try:
            if server is not None and _lets_in(number):
                yield {**os.environ, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"}
                return
        finally:
            if server is not None:
                server.terminate()
                server.wait(_SECONDS)
    raise GraderFault(f"Xvfb does not start: {_TRIES} screens could not be opened; `Xvfb :{_NUMBERS[0]}` says why")


def _started(number: int) -> "subprocess.Popen[bytes] | None":
    """Xvfb once it listens; none where it ended before that, as where the number is taken."""
    reading, writing = os.pipe()
    with os.fdopen(reading) as pipe:
        command = ["Xvfb", f":{number}", "-displayfd", str(writing), "-screen", "0", "800x600x24"]
        command += ["-nolisten", "tcp", "-noreset"]  # else it begins anew behind each last client, deaf meanwhile
        try:
            server = subprocess.Popen(command, pass_fds=[writing], stderr=subprocess.DEVNULL)
        except OSError as error:
            raise GraderFault(f"Xvfb does not start: {reason(error)}") from error
        finally:
            os.close(writing)
        if pipe.readline().strip():
            return server
    server.kill()
    server.wait(_SECONDS)
    return None


def _lets_in(number: int) -> bool:
    with socket.socket(socket.AF_UNIX) as client, suppress(OSError):
        client.settimeout(_SECONDS)
        client.connect(f"/tmp/.X11-unix/X{number}")  # noqa: S108 - where X11 has its sockets
        client.sendall(_HELLO)
        return client.recv(1) == b"\1"  # its "Success"
    return False
