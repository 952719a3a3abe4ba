"""The entries of the folder that was handed in, one submission each: how they are found, read and named."""

import errno
import hashlib
import os
import re
import stat
import unicodedata
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.platform import is_windows_device
from raysteps.common.text import one_line, printable
from raysteps.course.manifest import Step
from raysteps.submission.entries import is_out_of_sight
from raysteps.submission.load import ARCHIVE_ENDINGS, Submission, load_submission, without_place

MAX_FILES = 20_000  # of an entry that are looked at
_MAX_DEPTH = 6
_NO_SUBMISSIONS = {"__MACOSX", "Thumbs.db", "desktop.ini"}


@dataclass(frozen=True)
class ClassEntry:
    """One entry; its label is its name as text that can be printed and stored."""

    path: Path
    label: str
    leads_to: tuple[str, ...] = ()  # the labels of other entries whose files a link has, or some of them


class NoSubmission(UsageError):
    """Nobody has handed anything in."""


@dataclass(frozen=True)
class Listing:
    """What a folder holds."""

    entries: list[ClassEntry]
    ignored: list[str]


@dataclass(frozen=True)
class Shard:
    """The part of a class that one of several machines grades; counted from 1."""

    index: int = 1
    count: int = 1

    def holds(self, label: str) -> bool:
        """By the name alone: whatever else is handed in meanwhile, each entry belongs to exactly one shard."""
        digest = hashlib.sha256(label.encode()).digest()
        return int.from_bytes(digest[:8], "big") % self.count == self.index - 1

    def __str__(self) -> str:
        return f"{self.index}/{self.count}"


def read_shard(text: str) -> Shard:
    """From `2/8`."""
    found = re.fullmatch(r"([0-9]{1,6})/([0-9]{1,6})", text)
    if found is None or not 1 <= int(found[1]) <= int(found[2]):
        raise UsageError(f"--shard {text}: expected i/n with i from 1 to n, such as 2/8")
    return Shard(int(found[1]), int(found[2]))


def _label(path: Path, known: set[str]) -> str:
    """A name that is not UTF-8, or that steers a terminal, can be neither stored nor printed as it is."""
    label = one_line(os.fsencode(path.name).decode("utf-8", "backslashreplace"))
    mark = hashlib.sha256(os.fsencode(path.name)).hexdigest()
    return label if label.strip() and label not in known else f"{label} {mark}".strip()


def _told_apart(entries: Sequence[ClassEntry], folder: Path) -> list[ClassEntry]:
    """Two entries must not be one submission: a link says so that shares files with another entry. One that leads out
    of the folder is an entry as any other."""
    root = Path(os.path.realpath(folder))
    places = [Path(os.path.realpath(entry.path)) for entry in entries]
    at, within = defaultdict[Path, list[str]](list), defaultdict[Path, list[str]](list)
    for entry, place in zip(entries, places, strict=True):
        at[place].append(entry.label)
        for above in (place, *place.parents):
            within[above].append(entry.label)
    found = []
    for entry, place in zip(entries, places, strict=True):
        is_link = place != root / entry.path.name
        shared = [*within[place], *(label for above in place.parents for label in at[above])] if is_link else []
        found.append(replace(entry, leads_to=tuple(label for label in shared if label != entry.label)))
    return found


def list_entries(folder: Path, leave_out: list[Path]) -> Listing:
    """In an order that does not depend on the machine."""
    try:
        paths = sorted(folder.iterdir(), key=lambda path: os.fsencode(path.name))
    except OSError as error:
        found = "it is no folder" if folder.is_file() else reason(error)
        raise UsageError(f"{folder}: {found}; expected a folder with one entry per submission") from error
    entries: list[ClassEntry] = []
    ignored: list[str] = []
    known: set[str] = set()
    left_out = {os.path.realpath(path) for path in leave_out}
    for path in paths:
        label = _label(path, known)
        known.add(label)
        if path.name.startswith(".") or path.name in _NO_SUBMISSIONS or os.path.realpath(path) in left_out:
            ignored.append(label)
        else:
            entries.append(ClassEntry(path, label))
    if not entries:
        raise NoSubmission(f"{folder}: holds no submission; expected one folder, zip or tar per submission")
    return Listing(_told_apart(entries, folder), ignored)


def _children(folder: Path) -> Iterator[tuple[Path, os.stat_result]]:
    """Without what cannot be read: it is not taken either."""
    with suppress(OSError):
        for child in folder.iterdir():
            with suppress(OSError):
                yield child, child.lstat()


def _file_times(folder: Path) -> Iterator[float]:
    stack = [(folder, 1)]
    seen = 0
    while stack:
        current, depth = stack.pop()
        for child, status in _children(current):
            seen += 1
            if seen > MAX_FILES:
                return
            if child.name.startswith(".") or (stat.S_ISDIR(status.st_mode) and is_out_of_sight((child.name,))):
                continue
            if stat.S_ISREG(status.st_mode):
                yield status.st_mtime
            elif stat.S_ISDIR(status.st_mode) and depth < _MAX_DEPTH:
                stack.append((child, depth + 1))


def newest_time(path: Path) -> str:
    """When an entry was last changed, as far as its files tell; nothing when it holds none.

    Of an archive its own time counts, not its members': those are whatever the one who packed it wanted."""
    try:
        newest = max(_file_times(path), default=None) if path.is_dir() else path.stat().st_mtime
        return "" if newest is None else datetime.fromtimestamp(newest, UTC).isoformat(timespec="seconds")
    except (OSError, OverflowError, ValueError):
        return ""


# Reads the submissions of a class, one at a time.

# What a submission cannot bring about: then this machine cannot read it, and nobody's points may depend on that.
_OF_THIS_MACHINE = {
    *(errno.EACCES, errno.EPERM, errno.EIO, errno.ENOENT, errno.ESTALE),
    *(errno.EMFILE, errno.ENFILE, errno.ENOMEM),
}


@dataclass(frozen=True)
class LoadedEntry:
    """A submission under its safe name. One that could not be read has no sources, and a note for each step."""

    submission: Submission
    unreadable: bool = False


NOTHING_TAKEN = "Nothing was taken from this submission: it "  # before why
# Its student need not know whose; the note to the instructor says it.
ANOTHERS = "is a link to the files of another entry of the class, and no submission counts twice"


def load_entry(name: str, entry: ClassEntry, steps: list[Step]) -> LoadedEntry:
    """What the student packed badly is the student's; what this machine cannot read is a GraderFault."""
    path = entry.path
    try:
        if entry.leads_to:
            raise UsageError(ANOTHERS)
        if not path.exists():
            why = "is a link that leads nowhere" if path.is_symlink() else "is not there any more"
            raise GraderFault(f"{path}: {why}")
        if path.is_dir() and not os.access(path, os.R_OK | os.X_OK):
            raise GraderFault(f"{path}: this folder must not be read: no permission")
        return LoadedEntry(replace(load_submission(path, steps), name=name))
    except UsageError as error:
        cause: BaseException | None = error
        while cause is not None:
            if isinstance(cause, OSError) and cause.errno in _OF_THIS_MACHINE:
                raise GraderFault(f"the submission cannot be read: {error}") from error
            cause = cause.__cause__
        reason = printable(without_place(error, path))
        notes = {step.id: f"{NOTHING_TAKEN}{reason}." for step in steps}
        return LoadedEntry(Submission(name, {}, notes), unreadable=True)
    except GraderFault:
        raise
    except Exception as error:  # whatever it is, it is the fault of one submission, and the class goes on
        raise GraderFault(f"the submission cannot be read: {type(error).__name__}: {error}") from error


# Names of submissions: what they tell, and how they become safe as names of files on any system.

_MAX_BYTES = 100
# Only the beginning is the platform's; what comes after it may be a file name that a student chose.
_CANVAS = re.compile(r"([^\W_]+)_(?:LATE_)?([0-9]+)_([0-9]+)_")  # leeann_4711_815_steps
_MOODLE = re.compile(r"(.+?)_([0-9]+)_assignsubmission_")  # Ann Lee_123_assignsubmission_file


def stem(entry: str) -> str:
    """Without the ending of an archive."""
    for ending in ARCHIVE_ENDINGS:
        if entry.lower().endswith(ending) and len(entry) > len(ending):
            return entry[: -len(ending)]
    return entry


def platform_identity(entry: str) -> tuple[str, str]:
    """The name and the number that Canvas or Moodle gave to a download: of the student, as the platform counts them.

    Empty where no platform named it."""
    found = _CANVAS.match(entry) or _MOODLE.match(entry)
    return (found[1], found[2]) if found else ("", "")


def moodle_identity(entry: str) -> tuple[str, str]:
    """The same where Moodle named it; a download of Canvas gives nothing."""
    found = None if _CANVAS.match(entry) else _MOODLE.match(entry)
    return (found[1], found[2]) if found else ("", "")


def canvas_numbers(entry: str) -> tuple[str, str] | None:
    """Of the student and the upload, in the name that Canvas gives to a download; None for any other name."""
    found = _CANVAS.match(entry)
    return (found[2], found[3]) if found else None


def folded(text: str) -> str:
    """For comparisons: without differences of case, spacing and encoding."""
    return " ".join(unicodedata.normalize("NFKC", text).casefold().split())


def safe_name(text: str) -> str:
    """Letters, digits, `.`, `_` and `-` only; never hidden, empty, too long, or a device of Windows."""
    plain = unicodedata.normalize("NFKC", text)
    name = "".join(letter if letter.isalnum() or letter in "._-" else "_" for letter in plain).strip("._-")
    name = name.encode()[:_MAX_BYTES].decode("utf-8", "ignore").rstrip(".")
    return f"_{name}" if not name or is_windows_device(name) else name


def name_entries(entries: Sequence[str], known: Mapping[str, str]) -> dict[str, str]:
    """Entry -> name, no two alike even where a file system ignores case. One that has a name (`known`) keeps it."""
    names = {entry: known[entry] for entry in entries if entry in known}
    taken = {folded(name) for name in known.values()}
    wanted = {entry: safe_name(stem(entry)) for entry in entries if entry not in known}
    often = Counter(folded(name) for name in wanted.values())
    for entry, name in wanted.items():
        mark = hashlib.sha256(entry.encode("utf-8", "surrogateescape")).hexdigest()
        unique, length = name, 6
        # The mark comes from the entry itself, so that an entry that is added later changes no name.
        while folded(unique) in taken or (unique == name and often[folded(name)] > 1):
            unique, length = f"{name}-{mark[:length]}", length + 2
        names[entry] = unique
        taken.add(folded(unique))
    return names
