"""Archives and folders whose bytes depend on their content only."""

import io
import tarfile
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import usable_folder, write_bytes

_EPOCH = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Member:
    """A regular file in an archive."""

    name: str
    data: bytes
    executable: bool = False

    @property
    def mode(self) -> int:
        return 0o755 if self.executable else 0o644


def as_zip(members: Sequence[Member]) -> bytes:
    """A zip that keeps the executable bits."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for member in members:
            info = zipfile.ZipInfo(member.name, _EPOCH)
            info.create_system = 3  # Unix: the upper half of external_attr is the mode
            info.external_attr = (0o100000 | member.mode) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, member.data)
    return buffer.getvalue()


def as_tar(members: Sequence[Member]) -> bytes:
    """A plain tar."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for member in members:
            info = tarfile.TarInfo(member.name)
            info.size, info.mode = len(member.data), member.mode
            archive.addfile(info, io.BytesIO(member.data))
    return buffer.getvalue()


def into_folder(members: Sequence[Member], folder: Path) -> None:
    """Writes into a new or empty folder."""
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise UsageError(f"{folder}: is there already; expected the name of a new or an empty folder")
    usable_folder(folder)
    for member in members:
        path = folder / member.name
        write_bytes(path, member.data)
        path.chmod(member.mode)
