"""Where namespaces are refused, as in many containers: another user, Landlock and a filter of system calls, as far as
they are there."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.text import listed
from raysteps.sandbox.fences import landlock_version, scopes_signals
from raysteps.sandbox.isolation import Isolation
from raysteps.sandbox.kept import Kept
from raysteps.sandbox.mounts import compiler_command, hidden_folders, top_folders, visible_folders
from raysteps.sandbox.seccomp import syscall_filter
from raysteps.sandbox.task import Input, Task
from raysteps.sandbox.users import can_lend_users
from raysteps.sandbox.workplace import Workplace

_DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")
_LOADER_CACHE = "/etc/ld.so.cache"


def _without(folder: Path, hidden: list[Path]) -> Iterator[str]:
    """The folder, or, because a permission cannot have an exception, all of its parts but the hidden ones."""
    if folder in hidden:
        return
    if any(path.is_relative_to(folder) for path in hidden):
        for entry in folder.iterdir():
            yield from _without(entry, hidden)
    else:
        yield str(folder)


class Fallback(Kept):
    """Not strong: the task shares the machine's processes with the grader, and its limits count by process."""

    def __init__(self, secrets: tuple[Path, ...] = ()) -> None:
        self._secrets = list(secrets)
        self._lends_users = can_lend_users()
        self._version = landlock_version()
        self._filter = syscall_filter()
        if not self._lends_users and not self._version:
            raise GraderFault("there is no Landlock in this kernel, and only root can run code as another user")
        self.isolation = Isolation(
            "other user" if self._lends_users else "landlock", strong=False, description=self._describe()
        )

    def _describe(self) -> str:
        there: list[str] = []
        lacking: list[str] = []
        if self._lends_users:
            there.append("as a user of its own")
        if self._version:
            there.append("with its files limited by Landlock")
        else:
            lacking.append("it could read every file that is open to all users")
        if self._filter is not None:
            there.append("without network")
        elif self._version < 4:
            lacking.append("it could use the network")
        if not self._lends_users and not scopes_signals(self._version):
            lacking.append("it could end processes of the grader's user")
        lacking += ["it could see that other processes run", "memory was watched, not fenced off"]
        return f"The code ran {listed(there)}. There were no namespaces: {listed(lacking)}."

    def _locate(self, place: Workplace, given: Input) -> Path:
        return place.copied(given.path, given.inner_name)

    def _fences(self, task: Task, inputs: list[Path], folders: list[Path]) -> dict[str, Any] | None:
        first = task.command[0]
        compiler = compiler_command(first if isinstance(first, str) else "c++") if task.tools else None
        files = None
        if self._version:
            seen = [*visible_folders(compiler), *top_folders(compiler)]
            hidden = hidden_folders(seen, self._secrets)
            readable = [part for folder in seen for part in _without(folder, hidden)]
            readable += [_LOADER_CACHE, *(str(path) for path in inputs)]
            # A student's program has its outputs as open files; it needs no folder to write to.
            writable = [*_DEVICES, *(str(path) for path in folders if task.tools)]
            files = {"readable": readable, "writable": writable}
        return {"files": files, "system_calls": None if self._filter is None else self._filter.hex()}
