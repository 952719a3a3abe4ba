"""The paths inside a sandbox for the words of a task, and how its outputs come back."""

import os
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from tempfile import TemporaryFile

from raysteps.sandbox.mounts import compiler_command
from raysteps.sandbox.reading import read_regular
from raysteps.sandbox.task import Input, Task, Word

_MEGABYTE = 1 << 20


def _read_memory(fd: int, cap: int) -> bytes | None:
    return os.pread(fd, min(cap, os.fstat(fd).st_size), 0) or None


def nameless_file(data: bytes, stack: ExitStack) -> int:
    """An open file that holds the bytes, to be read from its beginning; another user can open it again by /dev/stdin
    where it is in memory."""
    if hasattr(os, "memfd_create"):
        fd = os.memfd_create("stdin")
    else:
        with TemporaryFile() as file:
            fd = os.dup(file.fileno())
    stack.callback(os.close, fd)
    with os.fdopen(fd, "wb", closefd=False) as writer:
        writer.write(data)
    os.lseek(fd, 0, os.SEEK_SET)
    return fd


class Inside:
    """What one task sees, under which names."""

    def __init__(self, task: Task, locate: Callable[[int, Input], str]) -> None:
        """`locate` makes the n-th input readable inside, and says under which path."""
        self._task = task
        self._cap = task.limits.file_mb * _MEGABYTE
        self._readers: dict[str, Callable[[], bytes | None]] = {}
        self._names: dict[Word, str] = {given: locate(n, given) for n, given in enumerate(task.all_inputs())}
        self.fds: list[int] = []

    def write_to_folder(self, folder: Path, name_inside: str) -> None:
        """A linker removes its output and makes it anew, so it needs a folder."""
        for output in self._task.all_outputs():
            self._names[output] = f"{name_inside}/{output.name}"
            self._readers[output.name] = partial(read_regular, folder / output.name, self._cap)

    def write_to_memory(self, stack: ExitStack) -> None:
        """A student's program gets open files without a name: it can write these, and make no others."""
        for output in self._task.all_outputs():
            fd = os.memfd_create(output.name)
            stack.callback(os.close, fd)
            self.fds.append(fd)
            self._names[output] = f"/dev/fd/{fd}"
            self._readers[output.name] = partial(_read_memory, fd, self._cap)

    def command(self) -> list[str]:
        first, *rest = self._task.command
        program = str(compiler_command(first)) if isinstance(first, str) else self._names[first]
        return [program, *(word if isinstance(word, str) else self._names[word] for word in rest)]

    def outputs(self) -> dict[str, bytes]:
        """To be asked for only when everything inside is dead."""
        read = {name: reader() for name, reader in self._readers.items()}
        return {name: data for name, data in read.items() if data is not None}
