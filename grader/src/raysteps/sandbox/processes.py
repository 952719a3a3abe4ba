"""What the processes of a task use, as /proc tells it."""

import ctypes
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

_TICKS = os.sysconf("SC_CLK_TCK")
_PAGE = os.sysconf("SC_PAGE_SIZE")
_PR_SET_CHILD_SUBREAPER = 36


@dataclass(frozen=True)
class Usage:
    """Of all processes of a task together."""

    cpu_seconds: float = 0.0
    memory_bytes: int = 0
    out_of_memory: bool = False  # the kernel said so


def _children_by_parent() -> dict[int, list[int]]:
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and (fields := _stat_fields(int(entry.name))):
            children.setdefault(int(fields[1]), []).append(int(entry.name))
    return children


def _children(pid: int) -> list[int]:
    found: list[int] = []
    for thread in Path(f"/proc/{pid}/task").iterdir():
        found += (int(word) for word in (thread / "children").read_bytes().split())
    return found


def _stat_fields(pid: int) -> list[bytes]:
    """The fields of /proc/PID/stat from the state on; none when the process is gone."""
    try:
        data = Path(f"/proc/{pid}/stat").read_bytes()
    except OSError:
        return []
    return data[data.rindex(b")") + 2 :].split()


def descendants(root: int) -> set[int]:
    """The process and all that came from it."""
    known: set[int] = set()
    waiting = [root]
    listed = None if Path("/proc/thread-self/children").exists() else _children_by_parent()
    while waiting:
        pid = waiting.pop()
        if pid in known:
            continue
        known.add(pid)
        try:
            waiting += _children(pid) if listed is None else listed.get(pid, [])
        except OSError:
            continue  # it ended meanwhile
    return known


def usage_of(pids: set[int]) -> Usage:
    cpu = memory = 0
    for pid in pids:
        fields = _stat_fields(pid)
        if fields:
            cpu += sum(int(field) for field in fields[11:15])  # own and reaped children's, in user and in system
            memory += int(fields[21])
    return Usage(cpu / _TICKS, memory * _PAGE)


class _Adoption:
    """Whether orphans below this process become its children: counted, because several threads may want it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._wanted = 0

    def change(self, by: int) -> None:
        with self._lock:
            self._wanted += by
            ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, int(self._wanted > 0), 0, 0, 0)


_adoption = _Adoption()


@contextmanager
def adopting_orphans() -> Iterator[None]:
    """Meanwhile, processes whose parent dies come to this process, which can then wait for them and learn what they
    used; otherwise they would go to init."""
    _adoption.change(+1)
    try:
        yield
    finally:
        _adoption.change(-1)


def reap(pid: int, handle: int) -> float:
    """The CPU seconds of a dead child and all that it waited for; 0 when it is no child (any more)."""
    try:
        if os.waitid(os.P_PIDFD, handle, os.WEXITED | os.WNOWAIT | os.WNOHANG) is None:
            return 0.0
        _, _, used = os.wait4(pid, 0)
    except ChildProcessError:
        return 0.0
    return used.ru_utime + used.ru_stime
