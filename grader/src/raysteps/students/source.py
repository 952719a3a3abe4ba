"""A newer release to take files from: a folder or a zip, perhaps with one outer folder."""

import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.students.listing import PLACE, Listed, Release, mark, parse

_MOST_BYTES = 256 << 20  # of one file
_EXPECTED = "expected a release of the kit: a folder or a zip with .raysteps/release.json in it"


@dataclass(frozen=True)
class Source:
    """The list of the files, and the files."""

    release: Release
    read: Callable[[str], bytes]

    def data(self, file: Listed) -> bytes:
        """Checked: half a download must not become half a kit."""
        try:
            data = self.read(file.path)
        except (OSError, KeyError, zipfile.BadZipFile) as error:
            raise UsageError(f"{file.path}: is missing in the new kit; expected a complete release") from error
        if mark(data) != file.mark:
            raise UsageError(f"{file.path}: is not as it was released; expected a complete, unchanged release")
        return data


def _in_folder(folder: Path) -> Source:
    inner = [path for path in folder.iterdir() if path.is_dir()] if not (folder / PLACE).is_file() else []
    root = next((path for path in inner if (path / PLACE).is_file()), folder)
    try:
        release = parse((root / PLACE).read_bytes(), str(root / PLACE))
    except OSError as error:
        raise UsageError(f"{folder}: is no release; {_EXPECTED}") from error
    return Source(release, lambda path: (root / path).read_bytes())


def _in_zip(path: Path, archive: zipfile.ZipFile) -> Source:
    found = sorted((name for name in archive.namelist() if name.endswith(PLACE)), key=len)
    if not found or found[0].removesuffix(PLACE).count("/") > 1:
        raise UsageError(f"{path}: holds no release; {_EXPECTED}")
    outer = found[0].removesuffix(PLACE)

    def read(name: str) -> bytes:
        if archive.getinfo(outer + name).file_size > _MOST_BYTES:
            raise UsageError(f"{name}: is too large for a file of the kit")
        return archive.read(outer + name)

    return Source(parse(read(PLACE), f"{path}, {PLACE}"), read)


@contextmanager
def open_source(path: Path) -> Iterator[Source]:
    """A kit that cannot be read changes nothing."""
    if path.is_dir():
        yield _in_folder(path)
        return
    try:
        archive = zipfile.ZipFile(path)
    except (OSError, zipfile.BadZipFile) as error:
        raise UsageError(f"{path}: cannot be read; {_EXPECTED}") from error
    with archive:
        yield _in_zip(path, archive)
