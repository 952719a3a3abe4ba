"""Reads a submission that is a zip. Nothing is ever unpacked to disk, and never more than a cap to memory."""

import io
import stat
import zipfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.submission import entries
from raysteps.submission.entries import Entry, check_size, check_unpacked, is_out_of_sight, not_a_file, split

_MAX_DIRECTORY = 32 << 20  # the list of all files, which the library reads at once


class _Directory(io.BufferedReader):
    """A zip whose list of files does not fill the memory."""

    def read(self, size: int | None = -1, /) -> bytes:
        if size is not None and size > _MAX_DIRECTORY:
            raise UsageError(f"{self.name}: more than {entries.MAX_ENTRIES} files; hand in the steps only")
        return super().read(_MAX_DIRECTORY if size is None or size < 0 else size)


def _kind_in_zip(info: zipfile.ZipInfo) -> str:
    """What an entry is when it is no file; archives made on Windows say nothing about it."""
    if info.is_dir():
        return "a folder"
    kind = stat.S_IFMT(info.external_attr >> 16)
    if kind in (0, stat.S_IFREG):
        return ""
    return "a link" if kind == stat.S_IFLNK else "a device"


def _read_zip(archive: zipfile.ZipFile, info: zipfile.ZipInfo, root: Path) -> bytes:
    check_size(info.file_size)
    if info.flag_bits & 1:
        raise UsageError(f"{root}: is encrypted; hand in an archive without a password")
    with archive.open(info) as file:
        data = file.read(entries.MAX_SOURCE + 1)
    check_size(len(data))
    return data


def zip_entries(root: Path) -> Iterator[Entry]:
    """The entries of a zip, as its directory lists them."""
    with _Directory(io.FileIO(root)) as raw, zipfile.ZipFile(raw) as archive:
        packed = root.stat().st_size
        seen = unpacked = 0
        for info in archive.infolist():
            # The library cuts a name at a NUL byte, which may hide another ending.
            parts = split(info.orig_filename)
            if parts is None or is_out_of_sight(parts[:-1]):
                continue
            seen += 1
            unpacked += info.file_size
            if seen > entries.MAX_ENTRIES:
                raise entries.too_many(root)
            check_unpacked(root, unpacked, packed)
            kind = _kind_in_zip(info)
            yield Entry(parts, not_a_file(kind) if kind else partial(_read_zip, archive, info, root))
