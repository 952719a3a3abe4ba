""".raysteps/release.json: which files of a students' repository are the kit's, and how they were; and what is
made beside them, which is neither the kit's nor a student's."""

import json
import os
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path, PurePosixPath
from typing import Annotated, Literal

from msgspec import Meta

from raysteps import __version__
from raysteps.common.documents import OPTIONAL, Malformed, Text, convert
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import content_hash, readable_json
from raysteps.common.platform import is_windows_device

# What setting up and trying a kit makes in its folder: no part of a release, and none of a student's own files.

FOLDERS = (".venv", "build")  # in the root
CACHE = "__pycache__"
HISTORY = ".git"


@dataclass(frozen=True)
class ReleasePath:
    """A path, how it is called from the root of the kit, and whether it is a folder that was made."""

    path: Path
    name: str
    made: bool


def is_made_anew(name: str) -> bool:
    """What Python makes wherever there is a package, and makes again when it is gone."""
    return any(part == CACHE or part.endswith(".egg-info") for part in PurePosixPath(name).parts)


def all_places(folder: Path, unreadable: Callable[[OSError], None] | None = None) -> Iterator[ReleasePath]:
    """Files and folders, but not the history. Nobody goes into a folder that was made; one that cannot be read is
    passed over, or told to `unreadable`."""
    for root, names, files in os.walk(folder, onerror=unreadable):
        for last in sorted([*names, *files]):
            path = Path(root, last)
            name = path.relative_to(folder).as_posix()
            made = (name in FOLDERS or is_made_anew(name)) and path.is_dir() and not path.is_symlink()
            if last in names and (made or name == HISTORY):
                names.remove(last)
            if name != HISTORY:
                yield ReleasePath(path, name, made)


# Which paths a list of files may hold: each leads to a place of its own, inside the folder, on every system.

_PART = re.compile(r"[A-Za-z0-9._+-]*[A-Za-z0-9_+-]")  # Windows drops a dot at the end; `.` and `..` are no names
_ALLOWED = "expected names of letters, digits and . _ + - only, with / between them"


def _folders(path: str) -> Iterator[str]:
    parts = path.split("/")[:-1]
    return ("/".join(parts[: count + 1]) for count in range(len(parts)))


def _complaint(path: str) -> str:
    parts = path.split("/")
    if not all(_PART.fullmatch(part) and not is_windows_device(part) for part in parts):
        return f"which is no name that every system can have; {_ALLOWED}"
    if ".git" in (part.lower() for part in parts) or parts[0].lower() in FOLDERS:
        return "which is never a file of the kit"
    if parts[0].lower() == ".raysteps":
        return "which is where the list itself is kept"
    return ""


def path_problem(paths: Iterable[str]) -> str:
    """What is wrong with the first that may not be in a list; nothing when all may. On Windows and macOS names that
    differ in case only are one file."""
    seen: set[str] = set()
    names = list(paths)
    folders = {folder.lower() for path in names for folder in _folders(path)}
    for path in names:
        wrong = _complaint(path)
        if path.lower() in seen:
            wrong = "or a name that differs from it in case only, twice"
        elif path.lower() in folders:
            wrong = "which is a folder of another file of the list"
        if wrong:
            return f"lists {path}, {wrong}"
        seen.add(path.lower())
    return ""


PLACE = ".raysteps/release.json"
_FORM: Literal["raysteps/release/v1"] = "raysteps/release/v1"
_MAX_BYTES = 16 << 20

Owner = Literal["kit", "student"]
StepId = Annotated[str, Meta(pattern="^[0-9]{2}-[a-z0-9-]+$")]


@dataclass(frozen=True)
class ListedFile:
    """One file. Those that the student writes are the student's from the first day on."""

    path: Text  # from the root, with /
    mark: Annotated[str, Meta(pattern="^[0-9a-f]{64}$")]  # SHA-256; of a text with LF
    owner: Owner = "kit"
    executable: bool = False

    def is_at(self, path: Path) -> bool:
        """Whether the file is there as it was released. Nobody looks behind a link; OSError where it cannot be read."""
        return not path.is_symlink() and content_hash(path.read_bytes()) == self.mark


@dataclass(frozen=True)
class Release:
    """What a course has given out: the form of the list. A later kit may add keys; this one reads past them."""

    course: Text
    kit: str  # fingerprint of the kit that it was made from
    steps: Annotated[tuple[StepId, ...], Meta(min_length=1)]
    files: tuple[ListedFile, ...]
    version: str = field(default=__version__, metadata=OPTIONAL)  # of that kit; empty where one before 0.2.0 made it
    schema: Literal["raysteps/release/v1"] = _FORM

    def by_path(self) -> dict[str, ListedFile]:
        return {file.path: file for file in self.files}


def encoded(release: Release) -> bytes:
    """The document; one that breaks its form is the kit's fault, a file that no repository may have the course's."""
    document = {"schema": release.schema, "version": release.version, **asdict(release)}
    try:
        convert(document, Release)
    except Malformed as error:
        raise GraderFault(f"release.json would break its form: {error}") from error
    wrong = path_problem(file.path for file in release.files)
    if wrong:
        raise UsageError(f"the release {wrong}. Give the file another name")
    return readable_json(document, indent=1).encode()


def parse(data: bytes, where: str) -> Release:
    """What somebody says is a release. Keys that nobody knows are of a later kit, and may stand there."""
    try:
        document = json.loads(data[:_MAX_BYTES])
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{where}: is not JSON; expected the list of a release's files") from error
    form = document.get("schema") if isinstance(document, dict) else None
    if isinstance(form, str) and form.startswith("raysteps/release/") and form != _FORM:
        raise UsageError(
            f"{where}: is a list of the form {form}, and this kit reads {_FORM}. Let the newer kit do the update: "
            "unpack it, and in its own folder type\n  python raysteps update --into YOUR-REPOSITORY"
        )
    told = {"version": ""} | document if isinstance(document, dict) else document
    try:
        release = convert(told, Release, complete=True, extra=True)
    except Malformed as error:
        raise UsageError(f"{where}: is not the list of a release's files: {error}") from error
    wrong = path_problem(file.path for file in release.files)
    if wrong:
        raise UsageError(f"{where}: {wrong}")
    return release


def read_release(folder: Path) -> Release | None:
    """None where the folder is no release."""
    path = folder / PLACE
    try:
        data = path.read_bytes()
    except OSError:
        return None
    return parse(data, str(path))


# Which files of a repository are the student's, by what they hold.


def _is_as_released(path: Path, file: ListedFile | None) -> bool:
    """What cannot be read is the student's own."""
    try:
        return file is not None and file.is_at(path)
    except OSError:
        return False


_MAX_NAMED = 5
_BUILT = ("CMakeLists.txt", "cmake/", "framework/", "scenes/", "steps/")  # or drawn, or tested with


def changed_files(root: Path) -> list[str]:
    """Files of the kit that a check goes by, and that are not as they were given out; none where nothing was, or where
    its list cannot be read."""
    release = None
    with suppress(UsageError):
        release = read_release(root)
    files = [] if release is None else [file for file in release.files if file.owner == "kit"]
    named = [file for file in files if file.path.startswith(_BUILT) and not file.path.endswith(".md")]
    return [file.path for file in named if not _is_as_released(root / file.path, file)]


def about_changed(root: Path) -> str:
    """What to say of them: a line of code that went into the wrong file may break what is right. Nothing where all are
    as they were."""
    names = changed_files(root)
    if not names:
        return ""
    more = f" and {len(names) - _MAX_NAMED} more" if len(names) > _MAX_NAMED else ""
    return (
        f"Not as the kit was given out, and not handed in: {', '.join(names[:_MAX_NAMED])}{more}. Your course grades "
        "with the kit's own: put back what it had, from a fresh copy, or with `git restore` if nothing was committed."
    )


def own_files(root: Path, kit: Release) -> list[str]:
    """All that is not as in this kit, steps first."""
    listed = kit.by_path()
    files = [place for place in all_places(root) if place.path.is_symlink() or not place.path.is_dir()]
    found = [it.name for it in files if it.name != PLACE and not _is_as_released(it.path, listed.get(it.name))]
    return sorted(found, key=lambda name: (not name.startswith("steps/"), name))
