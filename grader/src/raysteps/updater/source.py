"""A newer release to take files from: a folder or a zip, perhaps with one outer folder."""

import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError, reason
from raysteps.common.files import content_hash
from raysteps.common.text import join_and
from raysteps.updater.release_list import PLACE, ListedFile, Release, parse

_MAX_BYTES = 256 << 20  # of one file
_EXPECTED = "expected a release of the kit: a folder or a zip with .raysteps/release.json in it"
# What half a download, or a zip that was made in some other way, makes of reading.
_BROKEN = (OSError, EOFError, KeyError, RuntimeError, ValueError, zipfile.BadZipFile, zlib.error)


@dataclass(frozen=True)
class Source:
    """The list of the files, also byte for byte, and the files."""

    place: Path
    release: Release
    listing: bytes
    read: Callable[[str], bytes]

    def data(self, file: ListedFile) -> bytes:
        """Checked: half a download must not become half a kit."""
        try:
            data = self.read(file.path)
        except _BROKEN as error:
            raise UsageError(
                f"{file.path}: is not there in {self.place}, or cannot be read there; expected a complete release. "
                "Load it down or unpack it once more"
            ) from error
        if content_hash(data) != file.mark:
            raise UsageError(
                f"{file.path}: is not as it was released in {self.place}; expected a complete, unchanged release. "
                "Load it down or unpack it once more"
            )
        return data


def _source(place: Path, where: str, read: Callable[[str], bytes]) -> Source:
    try:
        data = read(PLACE)
    except _BROKEN as error:
        raise UsageError(f"{where}: cannot be read; {_EXPECTED}") from error
    return Source(place, parse(data, where), data, read)


def _the_only(path: Path, outer: list[str]) -> str:
    """Which of the kits that were found is meant; "" stands for what lies there without an outer folder."""
    if not outer:
        raise UsageError(f"{path}: holds no release; {_EXPECTED}")
    if "" not in outer and len(outer) > 1:
        raise UsageError(f"{path}: holds {join_and(sorted(outer))}; say which of them is the newer kit")
    return min(outer, key=len)


def _in_folder(folder: Path) -> Source:
    found = [""] if (folder / PLACE).is_file() else []
    if not found:
        found = [path.name for path in folder.iterdir() if (path / PLACE).is_file()]
    root = folder / _the_only(folder, found)
    return _source(root, str(root / PLACE), lambda path: (root / path).read_bytes())


def _in_zip(path: Path, archive: zipfile.ZipFile) -> Source:
    names = [name.split("/", 1) for name in archive.namelist()]
    found = [""] if PLACE in archive.namelist() else []
    outer = _the_only(path, found or sorted({name[0] for name in names if name[-1] == PLACE}))

    def read(name: str) -> bytes:
        info = archive.getinfo(f"{outer}/{name}" if outer else name)
        if info.flag_bits & 1:
            raise UsageError(f"{path}: has a password; expected a zip without one")
        if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise UsageError(f"{path}: is packed in a way that not every Python reads; expected a plain zip")
        if info.file_size > _MAX_BYTES:
            raise UsageError(f"{path}: {name} is too large for a file of the kit")
        return archive.read(info)

    return _source(path, f"{path}, {PLACE}", read)


@contextmanager
def open_source(path: Path) -> Iterator[Source]:
    """A kit that cannot be read changes nothing."""
    if path.is_dir():
        try:
            source = _in_folder(path)
        except OSError as error:
            raise UsageError(f"{path}: cannot be read: {reason(error)}; {_EXPECTED}") from error
        yield source
        return
    try:
        archive = zipfile.ZipFile(path)
    except FileNotFoundError:
        raise UsageError(f"{path}: is not there; {_EXPECTED}") from None
    except _BROKEN as error:
        raise UsageError(f"{path}: cannot be read as a zip; {_EXPECTED}") from error
    with archive:
        yield _in_zip(path, archive)
