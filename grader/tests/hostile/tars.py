"""Submissions that are tars. Each holds what the folder holds, which is honest, and something that is not."""

import io
import tarfile
import zipfile
from collections.abc import Mapping
from pathlib import Path

from hostile.folders import Maker, honest_sources

_PLACE = "steps/07-tone-mapping/tone_mapping.cpp"
_SOURCE = b'#include "steps/07-tone-mapping/tone_mapping.hpp"\n'


def _tar(folder: Path, entries: list[tuple[tarfile.TarInfo, bytes]], ending: str = ".tar") -> Path:
    path = folder.with_suffix(ending)
    mode = "w:gz" if ending == ".tar.gz" else "w"
    with tarfile.open(path, mode) as archive:  # type: ignore[call-overload]
        for name, data in honest_sources(folder).items():
            entries.append((tarfile.TarInfo(name), data))
        for info, data in entries:
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))
    return path


def _entry(name: str, kind: bytes = tarfile.REGTYPE, to: str = "") -> tarfile.TarInfo:
    info = tarfile.TarInfo(name)
    info.type, info.linkname = kind, to
    info.devmajor, info.devminor = 1, 5
    return info


def tar_that_leads_out(folder: Path, facts: Mapping[str, str]) -> Path:
    trace = facts["TRACE"]
    out = str(Path(trace).parent)
    names = [trace, "../" * 12 + trace.lstrip("/"), f"/{_PLACE}", f"../{_PLACE}", f"up/{Path(trace).name}"]
    first = [(_entry("up", tarfile.SYMTYPE, out), b""), (_entry("steps/07-tone-mapping", tarfile.SYMTYPE, out), b"")]
    return _tar(folder, first + [(_entry(name), _SOURCE) for name in names])


def tar_with_devices(folder: Path, facts: Mapping[str, str]) -> Path:
    entries = [
        (_entry(_PLACE, tarfile.CHRTYPE), b""),
        (_entry("steps/08-refraction/refraction.cpp", tarfile.FIFOTYPE), b""),
        (_entry("steps/06-octree/octree.cpp", tarfile.LNKTYPE, "/etc/passwd"), b""),
        (_entry("steps/05-reflection/reflection.cpp", tarfile.SYMTYPE, "/dev/zero"), b""),
        (_entry("disk", tarfile.BLKTYPE), b""),
    ]
    return _tar(folder, entries)


def tar_bomb(folder: Path, facts: Mapping[str, str]) -> Path:
    return _tar(folder, [(_entry("zeros.bin"), bytes(100 << 20))], ".tar.gz")


def tar_without_end(folder: Path, facts: Mapping[str, str]) -> Path:
    path = _tar(folder, [(_entry("a"), b"")])
    data = bytearray(path.read_bytes())
    data[124:136] = b"\x80" + b"\x00" * 3 + b"\x7f" + b"\xff" * 7  # a size of thousands of petabytes, by the GNU way
    data[148:156] = b" " * 8
    data[148:156] = f"{sum(data[:512]):06o}\0 ".encode()
    path.write_bytes(data)
    return path


def tar_of_holes(folder: Path, facts: Mapping[str, str]) -> Path:
    """As PAX 1.0 tells where they are: before the data, a number in a line."""
    entry = _entry("picture.raw")
    entry.pax_headers = {"GNU.sparse.major": "1", "GNU.sparse.minor": "0", "GNU.sparse.name": "picture.raw"}
    entry.pax_headers["GNU.sparse.realsize"] = "0"
    told = b"4000000\n" + b"0\n" * 8_000_000
    return _tar(folder, [(entry, told + bytes(-len(told) % 512))], ".tar.gz")


def tar_with_a_zip_at_its_end(folder: Path, facts: Mapping[str, str]) -> Path:
    """The zip holds what would count, were the tar taken for it."""
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as archive:
        for name, data in honest_sources(folder).items():
            archive.writestr(name, data)
    path = folder.with_suffix(".tar")
    with tarfile.open(path, "w") as outer:
        for name, data in {**honest_sources(folder), _PLACE: _SOURCE, "old.zip": inner.getvalue()}.items():
            info = _entry(name)
            info.size = len(data)
            outer.addfile(info, io.BytesIO(data))
    return path


TARS: dict[str, Maker] = {
    make.__name__: make
    for make in (
        *(tar_that_leads_out, tar_with_devices, tar_bomb, tar_without_end),
        *(tar_of_holes, tar_with_a_zip_at_its_end),
    )
}
