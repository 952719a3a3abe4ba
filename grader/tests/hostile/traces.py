"""What programs may leave behind on a machine: processes, mounts, files, shared memory, control groups."""

import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from sandboxes import control_groups

_SHARED = (Path("/dev/shm"), Path("/dev/mqueue"), Path("/var/tmp"))
_TABLES = (Path("/proc/sysvipc/shm"), Path("/proc/sysvipc/msg"), Path("/proc/sysvipc/sem"))


def _parents() -> dict[int, int]:
    parents = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                parents[int(entry.name)] = int((entry / "stat").read_text("latin-1").rpartition(")")[2].split()[1])
            except OSError:
                continue  # it is gone
    return parents


def _way_up(pid: int, parents: dict[int, int]) -> Iterator[int]:
    while pid in parents:
        yield pid
        pid = parents[pid]


def _looks_like_ours(pid: int, users: range) -> bool:
    try:
        entry = Path("/proc", str(pid))
        return entry.stat().st_uid in users or b"bwrap" in (entry / "cmdline").read_bytes()
    except OSError:
        return False


def _is_abandoned(pid: int, users: range, parents: dict[int, int]) -> bool:
    """One of the sandbox's that no living grader stands above; it may be another grader's, if that was killed."""
    top = next((above for above in _way_up(pid, parents) if not _looks_like_ours(above, users)), 1)
    return top == 1 and _looks_like_ours(pid, users)


def processes(users: range, spared: set[int]) -> set[int]:
    """Our own children, those of dead parents among them, and what the sandbox's users left to the first process."""
    parents = _parents()
    found = set()
    for pid in parents:
        above = set(_way_up(pid, parents))
        ours = os.getpid() in above or _is_abandoned(pid, users, parents)
        if ours and pid != os.getpid() and not above & spared:
            found.add(pid)
    return found


def _names(folder: Path) -> set[str]:
    try:
        return {str(path) for path in folder.iterdir()}
    except OSError:
        return set()


def _rows(table: Path) -> set[str]:
    try:
        return {f"{table} {' '.join(line.split()[:2])}" for line in table.read_text("ascii").splitlines()[1:]}
    except OSError:
        return set()


@dataclass(frozen=True)
class Traces:
    """A look at the machine. `spared` are roots of processes that others started on purpose."""

    temporary: Path
    users: range
    spared: Callable[[], set[int]]

    def now(self) -> set[str]:
        found = {f"process {pid}" for pid in processes(self.users, self.spared())}
        found |= {f"mount {line}" for line in Path("/proc/mounts").read_text("utf-8", "replace").splitlines()}
        found |= set().union(*(_names(folder) for folder in (*_SHARED, self.temporary)))
        found |= set().union(*(_rows(table) for table in _TABLES))
        return found | control_groups()

    def left_since(self, before: set[str], seconds: float = 5.0) -> set[str]:
        """What is new and stays: the kernel takes a moment to clear up behind a namespace."""
        deadline = time.monotonic() + seconds
        while (left := self.now() - before) and time.monotonic() < deadline:
            time.sleep(0.1)
        return left
