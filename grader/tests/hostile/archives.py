"""Submissions that are archives. Each holds what the folder holds, which is honest, and something that is not."""

import io
import os
import struct
import tarfile
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

Maker = Callable[[Path, Mapping[str, str]], Path]

_PLACE = "steps/07-tone-mapping/tone_mapping.cpp"
_SOURCE = b'#include "steps/07-tone-mapping/tone_mapping.hpp"\n'


def _honest(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*.cpp")}


def _zip(folder: Path, files: Mapping[str, bytes] | None = None, method: int = zipfile.ZIP_DEFLATED) -> Path:
    path = folder.with_suffix(".zip")
    with zipfile.ZipFile(path, "w", method) as archive:
        for name, data in (_honest(folder) | dict(files or {})).items():
            archive.writestr(name, data)
    return path


def _tar(folder: Path, entries: list[tuple[tarfile.TarInfo, bytes]], ending: str = ".tar") -> Path:
    path = folder.with_suffix(ending)
    mode = "w:gz" if ending == ".tar.gz" else "w"
    with tarfile.open(path, mode) as archive:  # type: ignore[call-overload]
        for name, data in _honest(folder).items():
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


def zip_that_leads_out(folder: Path, facts: Mapping[str, str]) -> Path:
    trace = facts["TRACE"]
    up = "../" * 12
    names = [trace, up + trace.lstrip("/"), "a/" + up + trace.lstrip("/"), "..\\" * 12 + trace.lstrip("/")]
    names += [f"C:{trace}", f"/{_PLACE}", f"../{_PLACE}", f"a/../{_PLACE}", f"\\\\server\\{_PLACE}"]
    return _zip(folder, dict.fromkeys(names, _SOURCE))


def zip_with_links(folder: Path, facts: Mapping[str, str]) -> Path:
    path = _zip(folder)
    with zipfile.ZipFile(path, "a") as archive:
        for name, to in ((_PLACE, facts["SECRET"]), ("steps/08-refraction", f"{facts['KIT']}/solutions/08-refraction")):
            link = zipfile.ZipInfo(name)
            link.create_system = 3
            link.external_attr = 0o120777 << 16
            archive.writestr(link, to)
        archive.writestr("steps/08-refraction/notes.txt", "x")
    return path


def _zip_of_zeros(folder: Path, name: str, megabytes: int) -> Path:
    path = _zip(folder)
    with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive, archive.open(name, "w") as file:
        for _ in range(megabytes):
            file.write(bytes(1 << 20))
    return path


def zip_bomb_flat(folder: Path, facts: Mapping[str, str]) -> Path:
    return _zip_of_zeros(folder, "zeros.bin", 500)


def zip_bomb_in_a_step(folder: Path, facts: Mapping[str, str]) -> Path:
    return _zip_of_zeros(folder, _PLACE, 20)


def zip_bomb_overlapping(folder: Path, facts: Mapping[str, str]) -> Path:
    data = _zip(folder, {_PLACE: bytes(900_000)}).read_bytes()
    start, end = data.index(b"PK\x01\x02"), data.index(b"PK\x05\x06")
    directory = data[start:end] * 1000
    tail = struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, 1000, 1000, len(directory), start, 0)
    path = folder.with_suffix(".zip")
    path.write_bytes(data[:start] + directory + tail)
    return path


def zip_bomb_nested(folder: Path, facts: Mapping[str, str]) -> Path:
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(_PLACE, bytes(10 << 20))
    for _ in range(3):
        outer = io.BytesIO()
        with zipfile.ZipFile(outer, "w", zipfile.ZIP_DEFLATED) as archive:
            for number in range(16):
                archive.writestr(f"{number}.zip", inner.getvalue())
        inner = outer
    return _zip(folder, {"more.zip": inner.getvalue(), "steps/07-tone-mapping/more.zip": inner.getvalue()})


def zip_of_many(folder: Path, facts: Mapping[str, str]) -> Path:
    return _zip(folder, {f"{number}.txt": b"" for number in range(100_000)}, zipfile.ZIP_STORED)


def zip_with_two_of_a_name(folder: Path, facts: Mapping[str, str]) -> Path:
    path = _zip(folder, {_PLACE: b"int shown;\n", _PLACE.replace("mapping.cpp", "mappinG.cpp"): b"int graded;\n"})
    path.write_bytes(path.read_bytes().replace(b"mappinG.cpp", b"mapping.cpp"))
    return path


def zip_encrypted(folder: Path, facts: Mapping[str, str]) -> Path:
    path = _zip(folder, {_PLACE: _SOURCE})
    data = bytearray(path.read_bytes())
    for mark, offset in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        at = data.find(mark)
        while at >= 0:
            data[at + offset] |= 1
            at = data.find(mark, at + 1)
    path.write_bytes(data)
    return path


def zip_damaged(folder: Path, facts: Mapping[str, str]) -> Path:
    path = _zip(folder, {_PLACE: os.urandom(2000).hex().encode()})
    data = bytearray(path.read_bytes())
    data[data.index(_PLACE.encode()) + 500] ^= 0xFF
    path.write_bytes(data)
    return path


def zip_odd_encodings(folder: Path, facts: Mapping[str, str]) -> Path:
    names = ["tone_mapp\u0131ng.cpp", "tone_mapping\u202ecpp.", "tone_mapping.\u0441pp", "\ufefftone_mapping.cpp"]
    names += ["tone_mappingX.cpp", "YYYY.cpp", "nul.cppZ.txt", "a" * 60_000]
    path = _zip(folder, dict.fromkeys(names, _SOURCE))
    data = path.read_bytes()
    data = data.replace(b"YYYY.cpp", b"\xff\xfe\x81\x9b.cpp").replace(b"nul.cppZ.txt", b"tone.cpp\0.txt"[:12])
    path.write_bytes(data)
    return path


def zip_from_windows(folder: Path, facts: Mapping[str, str]) -> Path:
    """Honest work by way of editors and programs that are not ours."""
    path = folder.with_suffix(".zip")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in _honest(folder).items():
            text = data.decode().replace("\n", "\r\n")
            archive.writestr(f"Work\\{name.title()}".replace("/", "\\"), text.encode("utf-16"))
    return path


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


ARCHIVES: dict[str, Maker] = {
    make.__name__: make
    for make in (
        zip_that_leads_out,
        zip_with_links,
        zip_bomb_flat,
        zip_bomb_in_a_step,
        zip_bomb_overlapping,
        zip_bomb_nested,
        zip_of_many,
        zip_with_two_of_a_name,
        zip_encrypted,
        zip_damaged,
        zip_odd_encodings,
        zip_from_windows,
        tar_that_leads_out,
        tar_with_devices,
        tar_bomb,
        tar_without_end,
    )
}
