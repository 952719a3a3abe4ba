"""Which kind of archive a submission is, and what its library raises when it is damaged."""

import lzma
import tarfile
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.submission.entries import Entry
from raysteps.submission.tars import tar_entries
from raysteps.submission.zips import zip_entries

DAMAGED = (
    OSError,
    tarfile.TarError,
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    ValueError,
    EOFError,
    RuntimeError,  # too many headers in one another
    NotImplementedError,
    LookupError,
    OverflowError,
)
_FOREIGN = {
    b"Rar!": "a RAR archive",
    b"7z\xbc\xaf\x27\x1c": "a 7z archive",
    b"\x28\xb5\x2f\xfd": "compressed with zstd",
}


def archive_entries(root: Path) -> Iterator[Entry]:
    """The entries of an archive of a kind that can be read here."""
    with root.open("rb") as file:
        start = file.read(8)
    foreign = next((name for magic, name in _FOREIGN.items() if start.startswith(magic)), "")
    if foreign:
        raise UsageError(f"{root}: is {foreign}; hand in a folder, a zip or a tar")
    return zip_entries(root) if zipfile.is_zipfile(root) else tar_entries(root)
