"""A program and all that it starts, to be ended together: as a process group, or as a job on Windows."""

import os
import signal
import subprocess
import sys
from contextlib import suppress
from typing import Any


def apart() -> dict[str, Any]:
    """For Popen: Ctrl-C on the terminal is for whoever starts the program, not for the program."""
    if sys.platform == "win32":
        return {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP | subprocess.CREATE_NO_WINDOW}
    return {"start_new_session": True}


def end_all(process: "subprocess.Popen[bytes]") -> None:
    """The program, and what it started. On Windows what a program leaves behind that has ended by itself is not found
    again."""
    if sys.platform == "win32":
        if process.poll() is None:
            words = ["taskkill", "/T", "/F", "/PID", str(process.pid)]
            with suppress(OSError, subprocess.TimeoutExpired):
                subprocess.run(words, capture_output=True, check=False, stdin=subprocess.DEVNULL, timeout=10)
            process.kill()
    else:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
