"""Programs that are typed, some of them with keys that are pressed while they run."""

import fcntl
import os
import signal
import subprocess
import termios
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

_SECONDS = 600


@dataclass(frozen=True)
class Keys:
    """What is pressed once the program has printed a line with these words; at once where there are none."""

    text: str
    after: str = ""


@dataclass(frozen=True)
class Ending:
    """How a program comes to its end, and what says that it went well."""

    keys: Keys | None = None
    codes: tuple[int, ...] = (0,)
    says: str = ""


@contextmanager
def _terminal() -> Iterator[tuple[int, int]]:
    """The person's end, and the program's."""
    ends = os.openpty()
    try:
        yield ends
    finally:
        for end in ends:
            os.close(end)


def _end(process: "subprocess.Popen[str]") -> None:
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)


def typed_at(name: str, words: list[str], here: Path, environment: dict[str, str], ending: Ending) -> str:
    """What a program printed that went well. With keys it reads from a terminal."""
    keys = ending.keys
    printed = ""
    with _terminal() as (mine, its):
        process = subprocess.Popen(
            words,
            cwd=here,
            env=environment,
            stdin=its if keys else subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            encoding="utf-8",
            start_new_session=True,
            preexec_fn=(lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0) and None) if keys else None,
        )
        late = threading.Timer(_SECONDS, _end, [process])
        late.start()
        try:
            assert process.stdout is not None
            if keys and not keys.after:
                os.write(mine, keys.text.encode())
            for line in process.stdout:
                printed += line
                if keys and keys.after and keys.after in line:
                    os.write(mine, keys.text.encode())
            code = process.wait()
        finally:
            late.cancel()
            _end(process)
    assert code in ending.codes, f"{name}: exit code {code}\n{printed}"
    assert ending.says in printed, f"{name}: expected it to say '{ending.says}'\n{printed}"
    return printed
