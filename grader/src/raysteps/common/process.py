"""Runs a program that is trusted, with a time limit and a cap on what it may say. Others run in a sandbox."""

import os
import selectors
import signal
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

_MEGABYTE = 1 << 20


@dataclass(frozen=True)
class Outcome:
    """How a program ended. The exit code of a student's program proves nothing by itself."""

    code: int
    timed_out: bool
    stdout: str
    stderr: str
    seconds: float

    @property
    def signal_name(self) -> str | None:
        """Such as SIGSEGV, when a signal ended the program."""
        if self.timed_out or self.code >= 0:
            return None
        try:
            return signal.Signals(-self.code).name
        except ValueError:
            return f"signal {-self.code}"


def _kill_group(pid: int) -> None:
    try:
        os.killpg(pid, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        return


def _drain(process: "subprocess.Popen[bytes]", deadline: float, cap: int) -> tuple[bool, bytes, bytes]:
    """Reads both pipes until they close, the program is gone for a second, or time is up."""
    assert process.stdout is not None
    assert process.stderr is not None
    kept = {process.stdout: bytearray(), process.stderr: bytearray()}
    ended_at: float | None = None
    with selectors.DefaultSelector() as selector:
        for opened in kept:
            selector.register(opened, selectors.EVENT_READ)
        while selector.get_map():
            now = time.monotonic()
            if now > deadline and process.poll() is None:
                return True, bytes(kept[process.stdout]), bytes(kept[process.stderr])
            if ended_at is None and process.poll() is not None:
                ended_at = now
                _kill_group(process.pid)
            if ended_at is not None and now > ended_at + 1:
                break
            for key, _ in selector.select(min(0.2, max(0.0, deadline - now))):
                pipe = key.fileobj
                assert not isinstance(pipe, int)
                data = os.read(key.fd, 65536)
                if not data:
                    selector.unregister(pipe)
                for known, buffer in kept.items():
                    if known is pipe:
                        buffer += data[: max(0, cap - len(buffer))]
    try:
        process.wait(max(0.0, deadline - time.monotonic()))
    except subprocess.TimeoutExpired:
        return True, bytes(kept[process.stdout]), bytes(kept[process.stderr])
    return False, bytes(kept[process.stdout]), bytes(kept[process.stderr])


def run(
    command: Sequence[str | Path],
    *,
    seconds: float,
    cwd: Path | None = None,
    cap: int = _MEGABYTE,
) -> Outcome:
    """Runs the words of a command, never a shell; kills its whole process group in the end."""
    start = time.monotonic()
    process = subprocess.Popen(
        [str(word) for word in command],
        cwd=cwd,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    with process:
        try:
            timed_out, out, err = _drain(process, start + seconds, cap)
        finally:
            _kill_group(process.pid)
            code = process.wait()
    return Outcome(
        code=code,
        timed_out=timed_out,
        stdout=out.decode("utf-8", "replace"),
        stderr=err.decode("utf-8", "replace"),
        seconds=time.monotonic() - start,
    )
