"""The forms in which generated submissions are handed in."""

import gzip
import io
import tarfile
import zipfile
from collections.abc import Mapping
from pathlib import Path

from raysteps.common.files import write_bytes
from raysteps.kit.manifest import Step

FORMS = ("folder", "flat folder", "zip", "zip with a folder", "tar.gz", "tar")


def _zip(files: dict[str, bytes]) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name), data)  # always of 1980, so that the bytes are always the same
    return out.getvalue()


def _tar(files: dict[str, bytes]) -> bytes:
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w") as archive:
        for name, data in files.items():
            info = tarfile.TarInfo(name)
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))
    return out.getvalue()


def write_sample(base: Path, form: str, sources: Mapping[str, str], steps: list[Step]) -> Path:
    paths = {step.id: step.file if form == "flat folder" else f"steps/{step.path.as_posix()}" for step in steps}
    top = "work/" if form == "zip with a folder" else ""
    files = {top + paths[step]: text.encode() for step, text in sources.items()}
    if form in ("folder", "flat folder"):
        for name, data in files.items():
            write_bytes(base / name, data)
        return base
    ending, data = {
        "tar": (".tar", _tar(files)),
        "tar.gz": (".tar.gz", gzip.compress(_tar(files), mtime=0)),
    }.get(form, (".zip", _zip(files)))
    path = base.with_name(base.name + ending)
    write_bytes(path, data)
    return path
