"""Limits for all processes of a task together, where the kernel lets this process make control groups."""

import os
import secrets
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.sandbox.monitor import Usage
from raysteps.sandbox.task import Limits

_MEGABYTE = 1 << 20
_REMOVE_SECONDS = 2.0
_PREFIX = "raysteps-"
_MUCH = 0.25  # of the memory that a task may have: an honest one stays below it


@dataclass(frozen=True)
class Parents:
    """The groups that new ones are made in. Version 1 has a tree for each resource, version 2 one for all."""

    memory: Path
    pids: Path
    cpu: Path | None
    unified: bool

    def all(self) -> list[Path]:
        return list(dict.fromkeys(path for path in (self.memory, self.pids, self.cpu) if path is not None))


class Cgroup:
    """The group of one task."""

    def __init__(self, parents: Parents, name: str, limits: Limits) -> None:
        self._unified = parents.unified
        self._memory_limit = limits.memory_mb * _MEGABYTE
        self._memory = parents.memory / name
        self._pids = parents.pids / name
        self._cpu = parents.cpu and parents.cpu / name
        self.folders = [parent / name for parent in parents.all()]
        for folder in self.folders:
            folder.mkdir()
        self._limit(limits)

    def _limit(self, limits: Limits) -> None:
        memory = str(self._memory_limit)
        if self._unified:
            (self._memory / "memory.max").write_text(memory, encoding="ascii")
            swap = self._memory / "memory.swap.max"
            if swap.exists():
                swap.write_text("0", encoding="ascii")
        else:
            (self._memory / "memory.limit_in_bytes").write_text(memory, encoding="ascii")
            with_swap = self._memory / "memory.memsw.limit_in_bytes"
            if with_swap.exists():
                with_swap.write_text(memory, encoding="ascii")
        # One more for the first process of the sandbox, which waits for the others.
        (self._pids / "pids.max").write_text(str(limits.processes + 1), encoding="ascii")

    def join(self, pid: int) -> None:
        """Its children, from now on, belong to the group as well."""
        for folder in self.folders:
            (folder / "cgroup.procs").write_text(str(pid), encoding="ascii")

    def _cpu_seconds(self) -> float:
        if self._cpu is None:
            return 0.0
        if not self._unified:
            return int((self._cpu / "cpuacct.usage").read_bytes()) / 1e9
        return _counter(self._cpu / "cpu.stat", "usage_usec") / 1e6

    def usage(self) -> Usage:
        """The kernel holds the memory limit itself, so its amount is of no interest here."""
        return Usage(cpu_seconds=self._cpu_seconds(), out_of_memory=self._was_killed_in())

    def _was_killed_in(self) -> bool:
        """Whether the kernel ended one of its processes for want of memory."""
        return _counter(self._memory / ("memory.events" if self._unified else "memory.oom_control"), "oom_kill") > 0

    def _took_much(self) -> bool:
        peak = self._memory / ("memory.peak" if self._unified else "memory.max_usage_in_bytes")
        if peak.exists():
            return int(peak.read_bytes()) >= _MUCH * self._memory_limit
        return _counter(self._memory / "memory.events", "max") > 0  # an older kernel tells that it met its limit

    def require_memory_of_the_machine(self) -> None:
        """A task that took little, and was ended for want of memory all the same, is a victim of others. To be asked
        when all its processes are dead."""
        if self._was_killed_in() and not self._took_much():
            raise GraderFault(
                "the system ended what ran of the submission because the machine, or the container, had no more "
                "memory, not because of what that took: grade fewer at a time (--jobs)"
            )


def _remove(folder: Path) -> None:
    """Its processes are dead; the kernel may need a moment to let go of the last one."""
    until = time.monotonic() + _REMOVE_SECONDS
    while folder.exists():
        try:
            folder.rmdir()
        except OSError:
            if time.monotonic() > until:
                return
            time.sleep(0.002)


def _counter(file: Path, key: str) -> int:
    for line in file.read_text(encoding="ascii").splitlines():
        name, _, value = line.partition(" ")
        if name == key:
            return int(value)
    return 0


def _mounted() -> tuple[dict[str, Path], Path | None]:
    """The trees of version 1 by resource, and that of version 2."""
    trees: dict[str, Path] = {}
    unified = None
    for line in Path("/proc/self/mounts").read_text(encoding="utf-8").splitlines():
        _, place, kind, options = line.split()[:4]
        if kind == "cgroup":
            trees.update({option: Path(place) for option in options.split(",")})
        elif kind == "cgroup2":
            unified = Path(place)
    return trees, unified


def _own_paths() -> dict[str, str]:
    """Where this process is in each tree; version 2 has no name."""
    paths: dict[str, str] = {}
    for line in Path("/proc/self/cgroup").read_text(encoding="utf-8").splitlines():
        _, names, path = line.split(":", 2)
        paths.update({name: path.lstrip("/") for name in names.split(",")})
    return paths


def _is_usable(parents: Parents) -> bool:
    """Tries it once, with one process of its own."""
    try:
        command = ["sleep", "60"]
        with new_cgroup(parents, Limits()) as group, subprocess.Popen(command) as process:
            try:
                group.join(process.pid)
                group.usage()
            finally:
                process.kill()
    except (OSError, ValueError):
        return False
    return not any(folder.exists() for folder in group.folders)


def _candidates() -> Iterator[Parents]:
    trees, unified = _mounted()
    own = _own_paths()
    if unified is not None:
        start = unified / own.get("", "")
        for folder in (start, *start.parents):
            if folder.is_relative_to(unified) and (folder / "cgroup.subtree_control").exists():
                passed_on = (folder / "cgroup.subtree_control").read_text(encoding="ascii").split()
                if {"memory", "pids"} <= set(passed_on):
                    yield Parents(folder, folder, folder, unified=True)
    if "memory" in trees and "pids" in trees:
        at = {name: trees[name] / own.get(name, "") for name in ("memory", "pids", "cpuacct") if name in trees}
        for place in (at, trees):
            yield Parents(place["memory"], place["pids"], place.get("cpuacct"), unified=False)


def _sweep(parents: Parents) -> None:
    """Removes what a grader that was killed could not remove."""
    for parent in parents.all():
        for folder in parent.glob(f"{_PREFIX}*-*"):
            owner = folder.name.removeprefix(_PREFIX).partition("-")[0]
            if not Path(f"/proc/{owner}").exists():
                with suppress(OSError):
                    folder.rmdir()


def find_parents() -> Parents | None:
    """Where groups can be made, entered and removed again; nothing where they cannot."""
    try:
        for parents in _candidates():
            if _is_usable(parents):
                _sweep(parents)
                return parents
    except (OSError, ValueError):
        pass
    return None


@contextmanager
def new_cgroup(parents: Parents, limits: Limits) -> Iterator[Cgroup]:
    name = f"{_PREFIX}{os.getpid()}-{secrets.token_hex(6)}"
    try:
        group = Cgroup(parents, name, limits)
        yield group
    finally:
        for parent in parents.all():
            _remove(parent / name)
