"""Which kind of archive a submission is, and what its library raises when it is damaged."""

import bz2
import copy
import gzip
import io
import lzma
import os
import stat
import tarfile
import time
import zipfile
import zlib
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import IO, Any, cast

from raysteps.common.errors import UsageError
from raysteps.submission import entries
from raysteps.submission.entries import FileEntry, check_size, check_unpacked, is_out_of_sight, not_a_file, split

_MAX_SECONDS = 30  # of computing, for an archive: the largest that is taken needs a few


class _Archive(io.FileIO):
    """The file of an archive, which is given up when the libraries compute for longer than an honest one takes."""

    def __init__(self, root: Path, *, may_be_link: bool) -> None:
        super().__init__(root, opener=None if may_be_link else _open_no_link)
        self._root = root
        self._ends = time.thread_time() + _MAX_SECONDS

    def hurry(self) -> None:
        if time.thread_time() > self._ends:
            raise UsageError(f"{self._root}: takes too long to unpack; hand in the steps only")

    def readinto(self, buffer: Any, /) -> int | None:
        self.hurry()
        return super().readinto(buffer)


def _open_no_link(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0))


# Reads a submission that is a tar, plain or compressed, as a stream: once, from front to end, up to a cap.

_MAX_HEADER = 1 << 16  # all that comes before the data of an entry: a long name, extensions, where its holes are
_MAX_FOR_ALL = 1000  # extensions that hold for all entries which follow: the library copies them for each


_GZIP, _BZIP2, _LZMA = b"\x1f\x8b", b"BZh", (b"\xfd7zXZ", b"\x5d\x00\x00")


def _unpacked(raw: IO[bytes]) -> IO[bytes]:
    start = raw.read(6)
    raw.seek(0)
    if start.startswith(_GZIP):
        return cast(IO[bytes], gzip.GzipFile(fileobj=raw))
    if start.startswith(_BZIP2):
        return bz2.BZ2File(raw)
    if start.startswith(_LZMA):
        return lzma.LZMAFile(raw)
    return raw


def _is_tar(start: bytes) -> bool:
    """By what a file begins with. A tar may end as a zip does, with a zip or an office document as its last entry."""
    if start.startswith((_GZIP, _BZIP2, *_LZMA)):
        return True
    try:
        tarfile.TarInfo.frombuf(start, tarfile.ENCODING, "surrogateescape")
    except tarfile.HeaderError:
        return False
    return True


class _Stream(io.RawIOBase):
    """An unpacked tar that is read once, from front to end, and not beyond a cap."""

    def __init__(self, root: Path, file: _Archive) -> None:
        self._root = root
        self._archive = file
        self._raw = io.BufferedReader(file)
        self._file = _unpacked(self._raw)
        self._count = 0
        self._reads_at_end = 0

    def read(self, size: int = -1, /) -> bytes:
        self._archive.hurry()  # much may be unpacked from what is in memory
        data = self._file.read(size)
        self._count += len(data)
        self._reads_at_end += not data
        if self._reads_at_end > 2:  # the library would go on for as long as an entry claims to be
            raise tarfile.ReadError("an entry is longer than the archive")
        check_unpacked(self._root, self._count, self._raw.tell())
        return data


class _Head:
    """The stream of an archive while the library reads what comes before the data of one entry."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._stream = stream
        self._left = _MAX_HEADER
        self.tell = stream.tell

    def read(self, size: int) -> bytes:
        self._left -= size
        if self._left < 0:
            raise tarfile.ReadError("a header with an impossible size")
        return self._stream.read(size)


class _Header(tarfile.TarInfo):
    """A header that asks for no more memory and time than an honest one."""

    @classmethod
    def frombuf(cls, buf: bytes | bytearray, encoding: str, errors: str) -> "_Header":
        try:
            header = super().frombuf(buf, encoding, errors)
        except tarfile.HeaderError as error:
            if not buf.strip(b"\0"):
                raise  # the end of the archive
            # The library would take it for the end too, and what follows for never handed in.
            raise tarfile.ReadError(str(error)) from error
        if header.size < 0:
            raise tarfile.ReadError("a header with an impossible size")
        return header

    def _proc_member(self, archive: Any) -> tarfile.TarInfo:
        """Where the library reads on after a header; the headers of one entry follow each other within it."""
        if len(archive.pax_headers) > _MAX_FOR_ALL:
            raise tarfile.ReadError("too many headers for all entries")
        stream = archive.fileobj
        if not isinstance(stream, _Head):
            archive.fileobj = _Head(stream)
        try:
            return super()._proc_member(archive)  # type: ignore[misc, no-any-return]
        finally:
            archive.fileobj = stream


def _kind_in_tar(info: tarfile.TarInfo) -> str:
    if info.isdir():
        return "a folder"
    if info.isreg():
        return ""
    return "a link" if info.issym() or info.islnk() else "a device"


def _read_tar(archive: tarfile.TarFile, info: tarfile.TarInfo) -> bytes:
    check_size(info.size)
    file = archive.extractfile(info)
    assert file is not None
    with file:
        return file.read(entries.MAX_SOURCE + 1)


def _tar_entries(root: Path, raw: _Archive) -> Iterator[FileEntry]:
    """The entries of a tar, plain or compressed, in their order."""
    stream = _Stream(root, raw)
    seen = 0
    # Read as a stream, an archive cannot send its reader backwards and round in circles.
    with tarfile.open(mode="r|", fileobj=stream, tarinfo=_Header) as archive:
        for info in archive:
            archive.members.clear()  # type: ignore[attr-defined]  # the library would remember every one
            parts = split(info.name)
            if parts is None or is_out_of_sight(parts[:-1]):
                continue
            seen += 1
            if seen > entries.MAX_ENTRIES:
                raise entries.too_many(root)
            kind = _kind_in_tar(info)
            yield FileEntry(parts, not_a_file(kind) if kind else partial(_read_tar, archive, info))


# Reads a submission that is a zip. Nothing is ever unpacked to disk, and never more than a cap to memory.

_MAX_DIRECTORY = 32 << 20  # the list of all files, which the library reads at once


class _Directory(io.BufferedReader):
    """A zip whose list of files does not fill the memory."""

    def read(self, size: int | None = -1, /) -> bytes:
        if size is not None and size > _MAX_DIRECTORY:
            raise entries.too_many(Path(self.name))
        return super().read(_MAX_DIRECTORY if size is None or size < 0 else size)


def _kind_in_zip(info: zipfile.ZipInfo) -> str:
    """What an entry is when it is no file; archives made on Windows say nothing about it."""
    kind = stat.S_IFMT(info.external_attr >> 16)
    if info.is_dir() or kind == stat.S_IFDIR:
        return "a folder"
    if kind in (0, stat.S_IFREG):
        return ""
    return "a link" if kind == stat.S_IFLNK else "a device"


_ENCRYPTED = 0x41  # in either of two ways
_ENDS_ITSELF = 0x02  # of LZMA: what is packed tells where it ends


def _packed(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> bytes:
    """The bytes of an entry as they lie in the archive."""
    stored = copy.copy(info)
    stored.compress_type, stored.file_size = zipfile.ZIP_STORED, info.compress_size
    del stored.CRC  # that of what is unpacked
    with archive.open(stored) as file:
        return file.read(entries.MAX_SOURCE + 1)


def _unpacking(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> IO[bytes]:
    """An entry to be read up to a cap. The library unpacks all that a few kB of BZIP2 or LZMA hold before it looks at
    how much was asked for, which may be gigabytes."""
    if info.compress_type not in (zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA):
        return archive.open(info)
    check_size(info.compress_size)
    packed = _packed(archive, info)
    if info.compress_type == zipfile.ZIP_BZIP2:
        return bz2.BZ2File(io.BytesIO(packed))
    size = -1 if info.flag_bits & _ENDS_ITSELF else info.file_size
    return lzma.LZMAFile(io.BytesIO(packed[4:9] + size.to_bytes(8, "little", signed=True) + packed[9:]))


def _read_zip(archive: zipfile.ZipFile, info: zipfile.ZipInfo, root: Path) -> bytes:
    check_size(info.file_size)
    if info.flag_bits & _ENCRYPTED:
        raise UsageError(f"{root}: is encrypted; hand in an archive without a password")
    with _unpacking(archive, info) as file:
        data = file.read(entries.MAX_SOURCE + 1)
    check_size(len(data))
    if zlib.crc32(data) != info.CRC:
        raise zipfile.BadZipFile("a file is not what it was when it was packed")
    return data


def _zip_entries(root: Path, raw: io.FileIO) -> Iterator[FileEntry]:
    """The entries of a zip, as its directory lists them."""
    packed = os.fstat(raw.fileno()).st_size
    with zipfile.ZipFile(_Directory(raw)) as archive:
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
            yield FileEntry(parts, not_a_file(kind) if kind else partial(_read_zip, archive, info, root))


DAMAGED = (
    OSError,
    tarfile.TarError,
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    ValueError,
    EOFError,
    RuntimeError,  # too many headers in one another, and a method that is not implemented
    LookupError,
    OverflowError,
    MemoryError,  # a few bytes may ask for a dictionary of gigabytes
)
_FOREIGN = {
    b"Rar!": "a RAR archive",
    b"7z\xbc\xaf\x27\x1c": "a 7z archive",
    b"\x28\xb5\x2f\xfd": "compressed with zstd",
}
FOREIGN_ENDINGS = (".rar", ".7z", ".zst")


def archive_entries(root: Path, *, may_be_link: bool) -> Iterator[FileEntry]:
    """The entries of an archive of a kind that can be read here."""
    with _Archive(root, may_be_link=may_be_link) as file:
        start = file.read(tarfile.BLOCKSIZE)
        foreign = next((name for magic, name in _FOREIGN.items() if start.startswith(magic)), "")
        if foreign:
            raise UsageError(f"{root}: is {foreign}; hand in a folder, a zip or a tar")
        if not _is_tar(start) and zipfile.is_zipfile(file):
            yield from _zip_entries(root, file)
        else:
            file.seek(0)
            yield from _tar_entries(root, file)
