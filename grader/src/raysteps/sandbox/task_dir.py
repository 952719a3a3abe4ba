"""A fresh folder on the host for one task: copies of what another user could not read, and outputs of tools."""

import os
import shutil
import stat
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path
from tempfile import TemporaryFile

from raysteps.common.errors import GraderFault
from raysteps.common.files import copy_program, try_lock
from raysteps.sandbox.namespaces import compiler_command
from raysteps.sandbox.task import Input, Task, Word, read_regular

_PREFIX = "raysteps-run-"
_GROUNDS = (Path("/tmp"), Path("/var/tmp"))  # noqa: S108  (for fresh names only)
_REMOVE_SECONDS = 120
_ABANDONED_SECONDS = 600.0  # longer than it takes from making a folder to locking it


def _mode(path: Path) -> int:
    return path.stat().st_mode


def _others_may_pass(folder: Path) -> bool:
    return all(_mode(above) & stat.S_IXOTH for above in (folder, *folder.parents))


def _others_may_read(path: Path) -> bool:
    """Whether any user can read the file, or the folder with all that is in it."""
    path = path.resolve()
    if not _others_may_pass(path.parent):
        return False
    if not path.is_dir():
        mode = _mode(path)
        return bool(mode & stat.S_IROTH) and bool(mode & stat.S_IXOTH or not mode & stat.S_IXUSR)
    for folder, _, files in os.walk(path):
        if _mode(Path(folder)) & 0o005 != 0o005:
            return False
        if not all(_mode(Path(folder, name)) & stat.S_IROTH for name in files):
            return False
    return True


def _copy_for_all(source: Path, target: Path, *, to_run: bool = False) -> None:
    """A copy that every user can read, whatever the modes of the original."""
    if source.is_dir():
        target.mkdir()
        for entry in source.iterdir():
            _copy_for_all(entry, target / entry.name)
        target.chmod(0o755)
    elif to_run:
        copy_program(source, target)
    else:
        shutil.copyfile(source, target)
        target.chmod(0o755 if _mode(source) & stat.S_IXUSR else 0o644)


def _common_ground() -> Path:
    """A folder for temporary files that other users can walk through."""
    for folder in (Path(tempfile.gettempdir()), *_GROUNDS):
        if folder.is_dir() and os.access(folder, os.W_OK) and _others_may_pass(folder.resolve()):
            return folder
    raise GraderFault("No folder for temporary files that other users can reach: set TMPDIR to one, such as /tmp.")


class TaskDir:
    """What a task sees of the host, as paths of the host."""

    def __init__(self, folder: Path, user: int | None) -> None:
        self._folder = folder
        self._user = user
        self._copies = 0

    def readable(self, path: Path, *, to_run: bool) -> Path:
        """The path itself, or a copy where the task's user could not read it."""
        if not path.exists():
            raise GraderFault(f"{path}: was to be read inside the sandbox, but it is not there.")
        if self._user is None or _others_may_read(path):
            return path.resolve()
        return self.copied(path, path.name, to_run=to_run)

    def copied(self, path: Path, name: str, *, to_run: bool) -> Path:
        """`to_run`: it is the program of the task, and not what another one opens."""
        self._copies += 1
        target = self._folder / f"in{self._copies}" / name
        target.parent.mkdir(mode=0o755)
        _copy_for_all(path, target, to_run=to_run)
        return target

    def linked(self, path: Path, name: str) -> Path:
        """The path itself, or a link where it is to have another name."""
        if path.name == name:
            return path.absolute()
        self._copies += 1
        link = self._folder / f"in{self._copies}" / name
        link.parent.mkdir(mode=0o755)
        link.symlink_to(path.absolute())
        return link

    def writable(self, name: str) -> Path:
        """A new folder that belongs to the task."""
        folder = self._folder / name
        folder.mkdir(mode=0o700)
        if self._user is not None:
            os.chown(folder, self._user, self._user)
        return folder


@contextmanager
def fresh_task_dir(user: int | None) -> Iterator[TaskDir]:
    """Goes with all that is in it, whatever modes its contents have."""
    parent = None if user is None else _common_ground()
    folder = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=parent))
    try:
        if user is not None:
            folder.chmod(0o711)
        with _locked(folder):
            yield TaskDir(folder, user)
    finally:
        remove_tree(folder)


@contextmanager
def _locked(folder: Path) -> Iterator[bool]:
    """Tells other graders that this one lives; false when another had told so before."""
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        yield try_lock(handle)
    finally:
        os.close(handle)


def sweep() -> None:
    """Removes the folders of graders that were killed, and could not do it themselves."""
    for parent in {Path(tempfile.gettempdir()), *_GROUNDS}:
        for folder in parent.glob(f"{_PREFIX}*"):
            with suppress(OSError):
                found = folder.lstat()
                if found.st_uid == os.geteuid() and time.time() - found.st_mtime > _ABANDONED_SECONDS:
                    _sweep_one(folder)


def _sweep_one(folder: Path) -> None:
    with _locked(folder) as is_abandoned:
        if is_abandoned:
            remove_tree(folder)


def remove_tree(folder: Path) -> None:
    """Also where a task took away its own right to list a folder, or made folders deeper than Python can follow."""
    with suppress(OSError, RecursionError):
        shutil.rmtree(folder)
        return
    for words in (["chmod", "-R", "u+rwx", "--", str(folder)], ["rm", "-rf", "--", str(folder)]):
        if os.geteuid() == 0 and words[0] == "chmod":
            continue
        with suppress(OSError, subprocess.TimeoutExpired):
            subprocess.run(words, check=False, capture_output=True, stdin=subprocess.DEVNULL, timeout=_REMOVE_SECONDS)


# The paths inside a sandbox for the words of a task, and how its outputs come back.

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


class PathMap:
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
