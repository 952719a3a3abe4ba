"""Writes files so that nobody ever sees half of one, and whole folders in the place of older ones."""

import errno
import hashlib
import json
import os
import re
import shutil
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError, reason

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"  # the first bytes of a PNG

# Locks between processes. A lock goes with the process that holds it, however that ends.

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

_POLL_SECONDS = 0.1


def try_lock(handle: int, *, shared: bool = False) -> bool:
    """Whether nobody else holds the lock of this open file; then it is held until the file is closed. Several may hold
    a shared one; Windows has none. A file system without locks raises OSError."""
    try:
        if sys.platform == "win32":
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(handle, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):  # the second one on Windows
        return False
    return True


def wait_for_lock(handle: int) -> None:
    """Until nobody else holds it."""
    if sys.platform == "win32":
        while not try_lock(handle):  # the waiting that Windows offers gives up after 10 seconds
            time.sleep(_POLL_SECONDS)
    else:
        fcntl.flock(handle, fcntl.LOCK_EX)


@contextmanager
def file_lock(lock: Path, wait: Callable[[], None] = lambda: None) -> Iterator[None]:
    """Waits until nobody else holds the lock; before that it calls `wait`."""
    lock.parent.mkdir(parents=True, exist_ok=True)
    with lock.open("a") as file:
        try:
            is_ours = try_lock(file.fileno())
        except OSError:
            is_ours = True  # a file system without locks
        if not is_ours:
            wait()
            wait_for_lock(file.fileno())
        yield


_REPLACE_SECONDS = 2.0


def usable_folder(path: Path) -> None:
    """Makes the folder that somebody named for results, or says that it cannot be written to."""
    if path.is_file():
        raise UsageError(f"{path}: is a file; expected a folder for the results, which may be a new one")
    import tempfile  # it takes long to load, and who only reads can do without

    try:
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    except OSError as error:
        raise UsageError(f"{path}: results cannot be written there: {reason(error)}") from error


def new_or_empty_folder(path: Path) -> None:
    """Makes the folder that somebody named for something whole, or says why it cannot be."""
    if path.exists() and not (path.is_dir() and not any(path.iterdir())):
        raise UsageError(f"{path}: is there already; expected the name of a new or an empty folder")
    usable_folder(path)


def open_regular(path: Path) -> int:
    """Opens a file to read its bytes: no link is followed and no pipe waited for where the system can do without."""
    wanted = ("O_BINARY", "O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC")
    return os.open(path, os.O_RDONLY | sum(getattr(os, name, 0) for name in wanted))


def _replace(temporary: Path, path: Path) -> None:
    """On Windows a file cannot be replaced while somebody, such as a virus scanner, has it open."""
    until = time.monotonic() + _REPLACE_SECONDS
    while True:
        try:
            temporary.replace(path)
        except PermissionError:
            if sys.platform != "win32" or time.monotonic() > until:
                raise
            time.sleep(0.05)
        else:
            return


def write_bytes(path: Path, data: bytes, *, mode: int = 0o644, ending: str = "") -> None:
    """Writes to a temporary name in the same folder, with that ending, then renames."""
    import tempfile

    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except FileExistsError as error:
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), str(path)) from error
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=ending, dir=path.parent)
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        temporary.chmod(mode)
        _replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def copy_program(source: Path, target: Path) -> None:
    """Copies a file that is to be run, by another program: what this process writes, a child that another thread has
    just started can hold open for a moment, and the system runs no file that is open for writing (ETXTBSY)."""
    target.unlink(missing_ok=True)  # and does not write over the one that runs
    if sys.platform == "win32":
        shutil.copyfile(source, target)
    else:
        import subprocess  # rarely

        words = ["cp", "--", str(source), str(target)]
        copied = subprocess.run(words, check=False, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
        if copied.returncode != 0:
            said = copied.stderr.decode(errors="replace").strip()
            raise GraderFault(f"{source}: cannot be copied to be run: {said}")
    target.chmod(0o755)


def forget_unfinished(folder: Path) -> None:
    """Removes what write_bytes left in the folder when it was killed. Only where nobody else is writing."""
    for path in folder.glob(".*.*"):
        if re.fullmatch(r"\..+\.[a-z0-9_]{8}", path.name) and path.is_file():
            path.unlink(missing_ok=True)


def readable_json(value: object, indent: int = 2) -> str:
    """Line by line, as all files of JSON are that people may read. Python's own writer is fast without lines only."""
    from msgspec.json import format as in_lines  # what is typed first may run before it is installed

    return in_lines(json.dumps(value, ensure_ascii=False, allow_nan=False), indent=indent) + "\n"


def write_json(path: Path, value: object) -> None:
    """Writes readable JSON."""
    write_bytes(path, readable_json(value).encode())


def refuse_to_write(path: Path) -> None:
    """Before anything is built or drawn for a file: a folder with a typing error in its name is not made."""
    if path.is_dir():
        raise UsageError(f"{path}: is a folder; expected the name of a file to write")
    if not path.parent.is_dir():
        raise UsageError(f"{path}: there is no folder {path.parent}; make it first, or write elsewhere")
    if not path.exists() and not os.access(path.parent, os.W_OK | os.X_OK):
        closed = PermissionError(errno.EACCES, "", str(path))
        raise UsageError(f"{path}: cannot be written: {reason(closed)}; write elsewhere")


def write_out(path: Path, data: bytes) -> None:
    """Writes a file that somebody named, or says why not."""
    try:
        write_bytes(path, data)
    except OSError as error:
        raise UsageError(f"{path}: cannot be written: {reason(error)}") from error


def encoded(document: object) -> bytes:
    """JSON for other programs, as it is written."""
    return readable_json(document, indent=1).encode()


def write_if_changed(path: Path, data: bytes) -> bool:
    """Leaves a file with the same content alone, so that nothing is rebuilt for it."""
    if path.is_file() and not path.is_symlink() and path.read_bytes() == data:
        return False
    write_bytes(path, data)
    return True


# A fingerprint that stays the same when git ends the lines of a text otherwise, as it may on Windows.


def normalized_line_ends(data: bytes) -> bytes:
    """A text with LF; anything else as it is."""
    return data if b"\0" in data else data.replace(b"\r\n", b"\n")


def content_hash(data: bytes) -> str:
    """SHA-256."""
    return hashlib.sha256(normalized_line_ends(data)).hexdigest()


# A folder that a command writes anew, in the place of what it wrote there before: a list in it says which files are its
# own, and what else lies there, such as a history, stays.


def _files(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


@dataclass(frozen=True)
class OwnedFolder:
    """One kind of them. `what` names it; with `hashed` the list tells the files' content, too, and a file that somebody
    changed is refused rather than lost."""

    what: str
    list_name: str
    schema: str
    hashed: bool = False

    def _list(self, out: Path) -> dict[str, Any] | None:
        try:
            document = json.loads((out / self.list_name).read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            return None
        if not isinstance(document, dict) or document.get("schema") != self.schema:
            return None
        return document if isinstance(document.get("files"), list) else None

    def _listed(self, out: Path) -> list[str] | None:
        """The files that were written before; none where none were. What a link leads out of the folder is not."""
        document = self._list(out)
        if document is None:
            return None
        paths = {str(name): (out / str(name)).resolve() for name in document["files"]}
        return [name for name, path in paths.items() if path.is_relative_to(out.resolve()) and not path.is_dir()]

    def _hashes(self, out: Path) -> dict[str, list[str]]:
        """Of the content that a file may have: one, or two where writing was interrupted."""
        hashes = (self._list(out) or {}).get("marks")
        return {name: one if isinstance(one, list) else [one] for name, one in dict(hashes or {}).items()}

    def check(self, out: Path) -> None:
        """A usage error unless it is a new or an empty folder, or an older one of the kind, which nobody changed."""
        names = self._listed(out)
        if out.is_file() or (out.is_dir() and any(out.iterdir()) and names is None):
            raise UsageError(f"{out}: holds something else; expected a new or an empty folder, or an older {self.what}")
        hashes = self._hashes(out)
        for name in names or ():
            path = out / name
            if name in hashes and path.is_file() and content_hash(path.read_bytes()) not in hashes[name]:
                raise UsageError(
                    f"{path}: was changed since the {self.what} was written and would be lost; take it away"
                )

    def put(self, new: Path, out: Path, last: str = "") -> None:
        """Moves the files of `new` to `out`, and `last` of all that one. Called again, it finishes what was
        interrupted."""
        out.mkdir(parents=True, exist_ok=True)
        old, files = self._listed(out) or [], _files(new)
        folders = {parent.as_posix() for name in files for parent in Path(name).parents}
        strange = [name for name in files if name not in old and (out / name).exists()]
        strange += sorted(name for name in folders if name not in old and (out / name).is_file())
        if strange:
            raise UsageError(
                f"{out / strange[0]}: is not of an older {self.what}, and the new one has such a file; take it away"
            )
        hashes = {name: content_hash((new / name).read_bytes()) for name in files} if self.hashed else {}
        before = self._hashes(out)
        either = before | {name: [*before.get(name, []), one] for name, one in hashes.items()}
        self._write(out, sorted({*old, *files}), either)
        for name in old:
            (out / name).unlink(missing_ok=True)
        for name in sorted(files, key=lambda name: name == last):
            (out / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.move(new / name, out / name)
        for folder in sorted({parent for name in old for parent in Path(name).parents}, reverse=True):
            if (out / folder).is_dir() and not any((out / folder).iterdir()):
                (out / folder).rmdir()
        self._write(out, files, hashes)

    def _write(self, out: Path, files: list[str], hashes: Mapping[str, str | list[str]]) -> None:
        document = {"schema": self.schema, "files": files}
        write_json(out / self.list_name, document | ({"marks": dict(hashes)} if self.hashed else {}))
