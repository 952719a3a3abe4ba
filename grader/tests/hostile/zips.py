"""Submissions that are zips. Each holds what the folder holds, which is honest, and something that is not."""

import io
import os
import struct
import zipfile
from collections.abc import Mapping
from pathlib import Path

from hostile.folders import Maker, honest_sources

_PLACE = "steps/07-tone-mapping/tone_mapping.cpp"
_SOURCE = b'#include "steps/07-tone-mapping/tone_mapping.hpp"\n'


def _zip(folder: Path, files: Mapping[str, bytes] | None = None, method: int = zipfile.ZIP_DEFLATED) -> Path:
    path = folder.with_suffix(".zip")
    with zipfile.ZipFile(path, "w", method) as archive:
        for name, data in (honest_sources(folder) | dict(files or {})).items():
            archive.writestr(name, data)
    return path


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
    return _zip_of_zeros(folder, "zeros.bin", 300)


def zip_bomb_in_a_step(folder: Path, facts: Mapping[str, str]) -> Path:
    return _zip_of_zeros(folder, _PLACE, 20)


def zip_bomb_that_lies(folder: Path, facts: Mapping[str, str]) -> Path:
    path = _zip(folder)
    with zipfile.ZipFile(path, "a", zipfile.ZIP_BZIP2) as archive, archive.open(_PLACE, "w") as file:
        for _ in range(1500):
            file.write(bytes(1 << 20))
    data = bytearray(path.read_bytes())
    at = data.rindex(b"PK\x01\x02") + 24  # the size in the list of all files
    data[at : at + 4] = struct.pack("<L", 1000)
    path.write_bytes(data)
    return path


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
        for name, data in honest_sources(folder).items():
            text = data.decode().replace("\n", "\r\n")
            archive.writestr(f"Work\\{name.title()}".replace("/", "\\"), text.encode("utf-16"))
    return path


ZIPS: dict[str, Maker] = {
    make.__name__: make
    for make in (
        zip_that_leads_out,
        zip_with_links,
        zip_bomb_flat,
        zip_bomb_in_a_step,
        zip_bomb_that_lies,
        zip_bomb_overlapping,
        zip_bomb_nested,
        zip_of_many,
        zip_with_two_of_a_name,
        zip_encrypted,
        zip_damaged,
        zip_odd_encodings,
        zip_from_windows,
    )
}
