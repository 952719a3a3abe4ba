"""Takes a submission in: a folder or an archive, of which only the known source files count."""

import lzma
import stat
import tarfile
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from raysteps.common.errors import UsageError
from raysteps.common.text import printable
from raysteps.kit.manifest import Step

_MAX_SOURCE = 1 << 20
_MAX_ENTRIES = 20_000
_MAX_DEPTH = 4  # of an accepted place: top folder, steps, step, file
_MAX_UNPACKED = 256 << 20
_DAMAGED = (
    OSError,
    tarfile.TarError,
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    ValueError,
    EOFError,
    RuntimeError,  # an encrypted zip
    NotImplementedError,
)


@dataclass(frozen=True)
class Submission:
    """The student's sources by step id; a step without a file is missing here."""

    name: str
    sources: dict[str, bytes]
    notes: dict[str, str]


@dataclass(frozen=True)
class _Entry:
    """A regular file that a submission holds."""

    path: PurePosixPath
    size: int
    where: Path | zipfile.ZipInfo | tarfile.TarInfo


def _wanted(steps: list[Step]) -> dict[tuple[str, ...], tuple[int, str]]:
    """Every accepted place with its rank and step; the most explicit place wins."""
    places: dict[tuple[str, ...], tuple[int, str]] = {}
    for step in steps:
        places["steps", step.id, step.file] = (0, step.id)
        places[step.id, step.file] = (1, step.id)
        places[(step.file,)] = (2, step.id)
    return places


def _is_out_of_sight(path: PurePosixPath) -> bool:
    """What counts as nothing, not even as a file too many: folders of tools, and what lies too deep."""
    folders = [part for part in path.parts[:-1] if part != "."]
    return len(folders) >= _MAX_DEPTH or any(part.startswith(".") or part == "__MACOSX" for part in folders)


def _too_many(root: Path) -> UsageError:
    return UsageError(f"{root}: more than {_MAX_ENTRIES} files; hand in the steps only")


def _folder_entries(root: Path) -> Iterator[_Entry]:
    stack = [(root, PurePosixPath())]
    seen = 0
    while stack:
        folder, prefix = stack.pop()
        for child in sorted(folder.iterdir()):
            status = child.lstat()
            if stat.S_ISDIR(status.st_mode) and (child.name.startswith(".") or child.name == "build"):
                continue
            seen += 1
            if seen > _MAX_ENTRIES:
                raise _too_many(root)
            if stat.S_ISDIR(status.st_mode) and len(prefix.parts) + 1 < _MAX_DEPTH:
                stack.append((child, prefix / child.name))
            elif stat.S_ISREG(status.st_mode):
                yield _Entry(prefix / child.name, status.st_size, child)


def _zip_entries(archive: zipfile.ZipFile, root: Path) -> Iterator[_Entry]:
    seen = 0
    for info in archive.infolist():
        path = PurePosixPath(info.filename.replace("\\", "/"))
        if _is_out_of_sight(path):
            continue
        seen += 1
        if seen > _MAX_ENTRIES:
            raise _too_many(root)
        kind = stat.S_IFMT(info.external_attr >> 16)
        if not info.is_dir() and kind in (0, stat.S_IFREG):
            yield _Entry(path, info.file_size, info)


def _tar_entries(archive: tarfile.TarFile, root: Path) -> Iterator[_Entry]:
    seen = 0
    for info in archive:
        # A compressed archive is unpacked up to where its next entry begins, before that entry can be read.
        if archive.offset > _MAX_UNPACKED:
            raise UsageError(f"{root}: more than {_MAX_UNPACKED >> 20} MB unpacked; hand in the steps only")
        path = PurePosixPath(info.name)
        if _is_out_of_sight(path):
            continue
        seen += 1
        if seen > _MAX_ENTRIES:
            raise _too_many(root)
        if info.isreg():
            yield _Entry(path, info.size, info)


def _place(path: PurePosixPath, wanted: dict[tuple[str, ...], tuple[int, str]]) -> tuple[int, str] | None:
    parts = tuple(part for part in path.parts if part != ".")
    if path.is_absolute() or ".." in parts or not parts or parts[0] == "__MACOSX":
        return None
    if parts in wanted:
        return wanted[parts]
    if parts[1:] in wanted:  # below one single top folder
        rank, step = wanted[parts[1:]]
        return rank + 3, step
    return None


def _pick(entries: Iterator[_Entry], steps: list[Step]) -> dict[str, list[_Entry]]:
    """For each step, the entries at its best place (more than one only when an archive repeats a name)."""
    wanted = _wanted(steps)
    best: dict[str, int] = {}
    picked: dict[str, list[_Entry]] = {}
    for entry in entries:
        place = _place(entry.path, wanted)
        if place is None:
            continue
        rank, step = place
        if rank < best.get(step, 99):
            best[step] = rank
            picked[step] = []
        if rank == best[step]:
            picked[step].append(entry)
    return picked


def _read_zip(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> bytes:
    with archive.open(info) as file:
        return file.read(_MAX_SOURCE + 1)


def _read_tar(archive: tarfile.TarFile, info: tarfile.TarInfo) -> bytes:
    file = archive.extractfile(info)
    return file.read(_MAX_SOURCE + 1) if file is not None else b""


def _collect(
    name: str, picked: dict[str, list[_Entry]], archive: zipfile.ZipFile | tarfile.TarFile | None
) -> Submission:
    sources: dict[str, bytes] = {}
    notes: dict[str, str] = {}
    for step, entries in picked.items():
        entry = entries[0]
        if len(entries) > 1:
            notes[step] = f"The submission holds {entry.path.name} more than once, so none of them was taken."
            continue
        if entry.size > _MAX_SOURCE:
            notes[step] = f"{entry.path.name} is larger than 1 MB and was not taken."
            continue
        if isinstance(archive, zipfile.ZipFile) and isinstance(entry.where, zipfile.ZipInfo):
            data = _read_zip(archive, entry.where)
        elif isinstance(archive, tarfile.TarFile) and isinstance(entry.where, tarfile.TarInfo):
            data = _read_tar(archive, entry.where)
        else:
            assert isinstance(entry.where, Path)
            data = entry.where.read_bytes()
        if len(data) > _MAX_SOURCE:
            notes[step] = f"{entry.path.name} is larger than 1 MB and was not taken."
        else:
            sources[step] = data
    return Submission(name, sources, notes)


def submission_name(path: Path) -> str:
    """The name of the folder, or of the archive without its ending."""
    # A name that is not UTF-8 carries halves of surrogates, which neither JSON nor a terminal takes.
    name = printable(path.resolve().name.encode("utf-8", "replace").decode("utf-8")).strip()
    for ending in (".tar.gz", ".tgz", ".tar.xz", ".tar.bz2", ".tar", ".zip"):
        if path.is_file() and name.lower().endswith(ending):
            name = name[: -len(ending)]
            break
    return "submission" if name in ("", ".", "..") else name


def take_in(path: Path, steps: list[Step]) -> Submission:
    """Reads a submission into memory; nothing is ever unpacked to disk."""
    name = submission_name(path)
    try:
        if path.is_dir():
            submission = _collect(name, _pick(_folder_entries(path), steps), None)
        elif not path.is_file():
            raise UsageError(f"{path}: there is no such submission")
        elif zipfile.is_zipfile(path):
            with zipfile.ZipFile(path) as zipped:
                submission = _collect(name, _pick(_zip_entries(zipped, path), steps), zipped)
        else:
            with tarfile.open(path) as tarred:
                submission = _collect(name, _pick(_tar_entries(tarred, path), steps), tarred)
    except _DAMAGED as error:
        raise UsageError(f"{path}: cannot be read as a folder, zip or tar ({error})") from error
    if not submission.sources and not submission.notes:
        raise UsageError(f"{path}: holds no step; expected files like steps/{steps[0].path.as_posix()}")
    return submission
