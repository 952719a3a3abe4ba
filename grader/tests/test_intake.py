"""What a submission may look like, and what is left outside."""

import io
import os
import tarfile
import zipfile
from pathlib import Path

import pytest

from raysteps.errors import UsageError
from raysteps.intake import take_in
from raysteps.manifest import Step

LAYOUTS = [
    "steps/02-intersection/intersection.cpp",
    "02-intersection/intersection.cpp",
    "intersection.cpp",
    "team one/steps/02-intersection/intersection.cpp",
    "team one/02-intersection/intersection.cpp",
    "team one/intersection.cpp",
]


def _zip(path: Path, files: dict[str, bytes]) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return path


def _tar(path: Path, files: dict[str, bytes]) -> Path:
    with tarfile.open(path, "w:gz") as archive:
        for name, data in files.items():
            info = tarfile.TarInfo(name)
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))
    return path


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("kind", ["folder", "zip", "tar"])
def test_layouts(tmp_path: Path, steps: list[Step], layout: str, kind: str) -> None:
    files = {layout: b"int x;", layout.replace("intersection.cpp", "main.cpp"): b"int main() {}"}
    if kind == "folder":
        path = tmp_path / "anna"
        for name, data in files.items():
            (path / name).parent.mkdir(parents=True, exist_ok=True)
            (path / name).write_bytes(data)
    else:
        path = _zip(tmp_path / "anna.zip", files) if kind == "zip" else _tar(tmp_path / "anna.tar.gz", files)
    submission = take_in(path, steps)
    assert submission.name == "anna"
    assert submission.sources == {"02-intersection": b"int x;"}


def test_the_most_explicit_place_wins(tmp_path: Path, steps: list[Step]) -> None:
    files = {"intersection.cpp": b"flat", "steps/02-intersection/intersection.cpp": b"steps"}
    assert take_in(_zip(tmp_path / "a.zip", files), steps).sources == {"02-intersection": b"steps"}


@pytest.mark.parametrize("name", ["../intersection.cpp", "/intersection.cpp", "a/../../intersection.cpp", "a/b/c.cpp"])
def test_paths_that_lead_out_are_ignored(tmp_path: Path, steps: list[Step], name: str) -> None:
    for path in (_zip(tmp_path / "a.zip", {name: b"x"}), _tar(tmp_path / "a.tgz", {name: b"x"})):
        with pytest.raises(UsageError, match="holds no step"):
            take_in(path, steps)


def test_links_and_pipes_are_refused(tmp_path: Path, steps: list[Step]) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret")
    folder = tmp_path / "bob"
    folder.mkdir()
    (folder / "intersection.cpp").symlink_to(secret)
    os.mkfifo(folder / "shadows.cpp")
    (folder / "reflection.cpp").write_text("int x;")
    assert set(take_in(folder, steps).sources) == {"05-reflection"}


def test_links_in_archives_are_refused(tmp_path: Path, steps: list[Step]) -> None:
    path = tmp_path / "a.tar"
    with tarfile.open(path, "w") as archive:
        for kind in (tarfile.SYMTYPE, tarfile.LNKTYPE):
            info = tarfile.TarInfo("intersection.cpp")
            info.type, info.linkname = kind, "/etc/passwd"
            archive.addfile(info)
    with pytest.raises(UsageError, match="holds no step"):
        take_in(path, steps)
    zipped = zipfile.ZipInfo("intersection.cpp")
    zipped.external_attr = 0o120777 << 16
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive_zip:
        archive_zip.writestr(zipped, "/etc/passwd")
    with pytest.raises(UsageError, match="holds no step"):
        take_in(tmp_path / "a.zip", steps)


def test_large_and_repeated_files_cost_their_step_only(tmp_path: Path, steps: list[Step]) -> None:
    path = tmp_path / "a.tar"
    with tarfile.open(path, "w") as archive:
        for name, data in [("intersection.cpp", b"a"), ("intersection.cpp", b"b"), ("shadows.cpp", b"x" * 2_000_000)]:
            info = tarfile.TarInfo(name)
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))
        info = tarfile.TarInfo("octree.cpp")
        info.size = 1
        archive.addfile(info, io.BytesIO(b"o"))
    submission = take_in(path, steps)
    assert submission.sources == {"06-octree": b"o"}
    assert "more than once" in submission.notes["02-intersection"]
    assert "larger than 1 MB" in submission.notes["04-shadows"]


def test_a_zip_bomb_is_not_unpacked(tmp_path: Path, steps: list[Step]) -> None:
    path = tmp_path / "bomb.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("intersection.cpp", b"\0" * 50_000_000)
    submission = take_in(path, steps)
    assert not submission.sources
    assert "larger" in submission.notes["02-intersection"]


@pytest.mark.parametrize("data", [b"", b"not an archive", b"PK\x03\x04broken", b"\x1f\x8bbroken"])
def test_junk_is_a_usage_error(tmp_path: Path, steps: list[Step], data: bytes) -> None:
    path = tmp_path / "junk.zip"
    path.write_bytes(data)
    with pytest.raises(UsageError):
        take_in(path, steps)
    with pytest.raises(UsageError, match="no such submission"):
        take_in(tmp_path / "missing", steps)
