"""What can go wrong, by exit code, and what the system says of files in words that a person can use."""

import codecs
import errno
import os
from pathlib import Path


class RaystepsError(Exception):
    """An error with a message for the person at the keyboard."""

    exit_code = 2


class UsageError(RaystepsError):
    """The command or one of its inputs makes no sense."""


class StudentBuildError(RaystepsError):
    """The student's own code does not build."""

    exit_code = 3


class GraderFault(RaystepsError):
    """The kit itself failed; never a student's zero."""

    exit_code = 4


_REASONS = {
    errno.ENOENT: "it is not there",
    errno.EEXIST: "something is there already",
    errno.EISDIR: "it is a folder",
    errno.ENOTDIR: "a part of the path is a file, not a folder",
    errno.EACCES: "no permission",
    errno.EPERM: "no permission",
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "the disk is full, or your share of it",
    errno.EROFS: "the disk is read-only",
    errno.ENAMETOOLONG: "the name is too long",
    errno.ELOOP: "its links lead in a circle",
    errno.EADDRINUSE: "another program has this place",
}

_SHARING_VIOLATION = 32


def is_full(error: OSError) -> bool:
    """Whether something could not be written for want of room."""
    return error.errno in (errno.ENOSPC, errno.EDQUOT)


def _is_folder(path: Path) -> bool:
    """Unlike Path's own, it raises nothing where a link leads into a closed folder."""
    return os.path.isdir(path)  # noqa: PTH112


_CLOSED = (errno.EACCES, errno.EPERM)


def _closed_folder(error: OSError) -> str:
    """Where not the file but a folder on the way to it is closed: what it is that needs permission; else nothing. The
    folder's name is enough beside the path that the message names."""
    if error.errno not in _CLOSED or not isinstance(error.filename, str):
        return ""
    path = Path(error.filename)
    for folder in reversed(path.absolute().parents):
        if not _is_folder(folder):
            return ""
        if not os.access(folder, os.X_OK):
            return f" to enter the folder {folder.name}"
    if not os.path.lexists(path) and not os.access(path.absolute().parent, os.W_OK):
        return f" to write in the folder {path.absolute().parent.name}"
    if _is_folder(path) and not os.access(path, os.R_OK | os.X_OK):
        return " for what is in this folder"
    return ""


def decode_error_position(error: UnicodeDecodeError) -> str:
    """`LINE:COLUMN` of what is not in the encoding, in what was read."""
    before = error.object[: error.start].decode(error.encoding, "replace")
    return f"{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}"


UTF16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)  # as its files begin


def _no_text(error: UnicodeDecodeError) -> str:
    if error.object.startswith(UTF16_MARKS):
        return "it is text in UTF-16; save it in UTF-8"
    line, _, column = decode_error_position(error).partition(":")
    return f"it is no text in UTF-8 (line {line}, column {column}); save it in UTF-8"


def reason(error: Exception) -> str:
    """Why a file could not be read or written, without numbers and without its path, which the message names."""
    if getattr(error, "winerror", None) == _SHARING_VIOLATION:  # to which Windows gives the number of EACCES
        return "another program has it open"
    if isinstance(error, OSError):
        return (_REASONS.get(error.errno or 0) or error.strerror or str(error)) + _closed_folder(error)
    return _no_text(error) if isinstance(error, UnicodeDecodeError) else str(error)


def reason_or_fault(error: Exception) -> str:
    """The same, and of what is no trouble with files, what a maintainer needs."""
    return reason(error) if isinstance(error, OSError) else repr(error)


def reason_and_place(error: Exception) -> str:
    """The same behind the path, for who does not know it."""
    where = f"{error.filename}: " if isinstance(error, OSError) and error.filename else ""
    return where + reason(error)
