"""What programs may leave behind on a machine: processes, mounts, files, shared memory, control groups."""

import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

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


def _belongs_to(pid: int, roots: set[int], parents: dict[int, int]) -> bool:
    while pid in parents:
        if pid in roots:
            return True
        pid = parents[pid]
    return False


def _is_ours(pid: int, users: range) -> bool:
    try:
        entry = Path("/proc", str(pid))
        command = (entry / "cmdline").read_bytes()
        return entry.stat().st_uid in users or b"/in/0/" in command or b"bwrap" in command
    except OSError:
        return False


def processes(users: range, spared: set[int]) -> set[int]:
    """Our own children and those whose parents died, the sandbox's, and those of the users that it lends."""
    parents = _parents()
    return {
        pid
        for pid in parents
        if pid != os.getpid()
        and not _belongs_to(pid, spared, parents)
        and (_belongs_to(pid, {os.getpid()}, parents) or _is_ours(pid, users))
    }


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
        groups = Path("/sys/fs/cgroup")
        return found | {
            str(path) for depth in ("*", "*/*", "*/*/*") for path in groups.glob(depth) if "raysteps" in path.name
        }

    def left_since(self, before: set[str], seconds: float = 5.0) -> set[str]:
        """What is new and stays: the kernel takes a moment to clear up behind a namespace."""
        deadline = time.monotonic() + seconds
        while (left := self.now() - before) and time.monotonic() < deadline:
            time.sleep(0.1)
        return left
