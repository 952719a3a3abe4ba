"""What a submission may look like, and what is left outside."""

import io
import lzma
import os
import struct
import sys
import tarfile
import zipfile
import zlib
from contextlib import suppress
from pathlib import Path
from typing import Literal

import pytest

from raysteps.classroom.entries import ClassEntry, load_entry
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.process import run
from raysteps.course.manifest import Step
from raysteps.submission import entries
from raysteps.submission.archives import archive_entries
from raysteps.submission.load import archives_beside, load_submission, submission_name, submissions_inside

LAYOUTS = [
    "steps/02-intersection/intersection.cpp",
    "02-intersection/intersection.cpp",
    "intersection.cpp",
    "team one/steps/02-intersection/intersection.cpp",
    "team one/02-intersection/intersection.cpp",
    "team one/intersection.cpp",
    "my project/raysteps-main/steps/02-intersection/intersection.cpp",
    "handed in/my project/raysteps-main/02-intersection/intersection.cpp",
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
    submission = load_submission(path, steps)
    assert submission.name == "anna"
    assert submission.sources == {"02-intersection": b"int x;"}


def test_the_most_explicit_place_wins(tmp_path: Path, steps: list[Step]) -> None:
    files = {"intersection.cpp": b"flat", "steps/02-intersection/intersection.cpp": b"steps"}
    assert load_submission(_zip(tmp_path / "a.zip", files), steps).sources == {"02-intersection": b"steps"}


@pytest.mark.parametrize("name", ["../intersection.cpp", "/intersection.cpp", "a/../../intersection.cpp", "a/b/c.cpp"])
def test_paths_that_lead_out_are_ignored(tmp_path: Path, steps: list[Step], name: str) -> None:
    for path in (_zip(tmp_path / "a.zip", {name: b"x"}), _tar(tmp_path / "a.tgz", {name: b"x"})):
        with pytest.raises(UsageError, match="holds no step"):
            load_submission(path, steps)


def test_links_and_pipes_are_refused(tmp_path: Path, steps: list[Step]) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret")
    folder = tmp_path / "bob"
    folder.mkdir()
    (folder / "intersection.cpp").symlink_to(secret)
    os.mkfifo(folder / "shadows.cpp")
    (folder / "reflection.cpp").write_text("int x;")
    submission = load_submission(folder, steps)
    assert set(submission.sources) == {"05-reflection"}
    assert submission.notes["02-intersection"] == "intersection.cpp is a link, not a file, and was not taken."
    assert "is a pipe" in submission.notes["04-shadows"]


def test_links_in_archives_are_refused(tmp_path: Path, steps: list[Step]) -> None:
    path = tmp_path / "a.tar"
    with tarfile.open(path, "w") as archive:
        for name, kind in (("intersection.cpp", tarfile.SYMTYPE), ("shadows.cpp", tarfile.LNKTYPE)):
            info = tarfile.TarInfo(name)
            info.type, info.linkname = kind, "/etc/passwd"
            archive.addfile(info)
    submission = load_submission(path, steps)
    assert not submission.sources
    assert set(submission.notes) == {"02-intersection", "04-shadows"}
    zipped = zipfile.ZipInfo("intersection.cpp")
    zipped.external_attr = 0o120777 << 16
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive_zip:
        archive_zip.writestr(zipped, "/etc/passwd")
    submission = load_submission(tmp_path / "a.zip", steps)
    assert not submission.sources
    assert "is a link" in submission.notes["02-intersection"]


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
    submission = load_submission(path, steps)
    assert submission.sources == {"06-octree": b"o"}
    assert "more than once" in submission.notes["02-intersection"]
    assert "larger than 1 MB" in submission.notes["04-shadows"]


def test_a_zip_bomb_is_not_unpacked(tmp_path: Path, steps: list[Step]) -> None:
    for size, words in ((20_000_000, "larger"), (50_000_000, "200 times its size"), (300_000_000, "256 MB unpacked")):
        path = tmp_path / f"{size}.zip"
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("intersection.cpp", "w") as file:
            for _ in range(size // 1_000_000):
                file.write(bytes(1_000_000))
        if size < 32_000_000:
            assert words in load_submission(path, steps).notes["02-intersection"]
        else:
            with pytest.raises(UsageError, match=words):
                load_submission(path, steps)


@pytest.mark.parametrize("data", [b"", b"not an archive", b"PK\x03\x04broken", b"\x1f\x8bbroken"])
def test_junk_is_a_usage_error(tmp_path: Path, steps: list[Step], data: bytes) -> None:
    path = tmp_path / "junk.zip"
    path.write_bytes(data)
    with pytest.raises(UsageError):
        load_submission(path, steps)
    with pytest.raises(UsageError, match="is not there"):
        load_submission(tmp_path / "missing", steps)


TOOLS = (".venv", "cmake-build-debug", "node_modules", "a/b/c/d/e/f")  # and what lies deeper than a step can


@pytest.mark.parametrize("kind", ["folder", "zip", "tar"])
def test_too_many_files_are_refused(
    tmp_path: Path, steps: list[Step], kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(entries, "MAX_ENTRIES", 10)
    files = {f"{place}/{number}": b"x" for number in range(20) for place in TOOLS}
    files["intersection.cpp"] = b"int x;"

    def pack(name: str) -> Path:
        if kind != "folder":
            return (_zip if kind == "zip" else _tar)(tmp_path / f"{name}.{kind}", files)
        for inner, data in files.items():
            (tmp_path / name / inner).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name / inner).write_bytes(data)
        return tmp_path / name

    assert load_submission(pack("few"), steps).sources == {"02-intersection": b"int x;"}
    files |= {f"more/{number}": b"x" for number in range(11)}
    with pytest.raises(UsageError, match="more than 10 files"):
        load_submission(pack("many"), steps)


def test_a_tar_bomb_is_refused(tmp_path: Path, steps: list[Step], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(entries, "MAX_UNPACKED", 2 << 20)
    path = _tar(tmp_path / "a.tgz", {"zeros": b"\0" * (3 << 20), "intersection.cpp": b"int x;"})
    with pytest.raises(UsageError, match="MB unpacked"):
        load_submission(path, steps)


def _xz_of(data: bytes, dictionary: int) -> bytes:
    """As if the file had been compressed with so large a dictionary: 40 is four gigabytes."""
    packed = bytearray(lzma.compress(data))
    size = 4 * (packed[12] + 1)
    packed[packed.index(b"\x21\x01", 12) + 2] = dictionary
    packed[12 + size - 4 : 12 + size] = struct.pack("<I", zlib.crc32(packed[12 : 12 + size - 4]))
    return bytes(packed)


def _zip_of(name: str, data: bytes) -> bytes:
    """As if the entry had been compressed with a dictionary of four gigabytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_LZMA) as archive:
        archive.writestr(name, data)
    packed = bytearray(buffer.getvalue())
    at = 30 + len(name) + 4 + 1  # the headers of the entry and of its data, and a byte of settings
    packed[at : at + 4] = b"\xff" * 4
    return bytes(packed)


_LOAD_IN_LITTLE_MEMORY = """
import resource, sys
from pathlib import Path
from raysteps.course.manifest import read_steps
from raysteps.course.project import here
from raysteps.submission.load import load_submission
resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))
print(load_submission(Path(sys.argv[1]), read_steps(here())).sources)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the limit is Linux's")
@pytest.mark.parametrize("kind", ["tar.xz", "zip"])
def test_a_decoder_that_asks_for_gigabytes_is_a_usage_error(tmp_path: Path, steps: list[Step], kind: str) -> None:
    name, buffer = f"steps/{steps[0].path.as_posix()}", io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w") as archive:
        info = tarfile.TarInfo(name)
        info.size = 4
        archive.addfile(info, io.BytesIO(b"int;"))
    path = tmp_path / f"handed-in.{kind}"
    path.write_bytes(_zip_of(name, b"int;") if kind == "zip" else _xz_of(buffer.getvalue(), 40))
    words: list[str | Path] = [sys.executable, "-c", _LOAD_IN_LITTLE_MEMORY, path]
    outcome = run(words, seconds=60)
    assert outcome.code != 0
    assert outcome.stderr.splitlines()[-1].startswith("raysteps.common.errors.UsageError: ")
    assert "cannot be read as a folder, zip or tar" in outcome.stderr


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_of_an_entry_no_more_is_unpacked_than_a_source_may_have(tmp_path: Path, method: int) -> None:
    """Whatever the zip says of its size: the library would unpack all of it before it finds the lie."""
    path, data = tmp_path / "ann.zip", b"/" * (1 << 20)
    with zipfile.ZipFile(path, "w", method) as archive:
        archive.writestr("fits.cpp", data)
        archive.writestr("grows.cpp", data * 8)
    packed = bytearray(path.read_bytes())
    at = packed.rindex(b"PK\x01\x02") + 24  # the size in the list of all files
    packed[at : at + 4] = b"\1\0\0\0"
    path.write_bytes(packed)
    found = archive_entries(path, may_be_link=True)
    assert next(found).read() == data
    grows = next(found)
    with pytest.raises(entries.RejectedFile, match="larger than 1 MB"):
        grows.read()


@pytest.mark.parametrize("ending", ["gz", "xz", "bz2"])
def test_damaged_archives_are_a_usage_error(tmp_path: Path, steps: list[Step], ending: str) -> None:
    whole = tmp_path / f"whole.tar.{ending}"
    modes: dict[str, Literal["w:gz", "w:xz", "w:bz2"]] = {"gz": "w:gz", "xz": "w:xz", "bz2": "w:bz2"}
    with tarfile.open(whole, modes[ending]) as archive:
        info = tarfile.TarInfo("intersection.cpp")
        info.size = 200_000
        archive.addfile(info, io.BytesIO(os.urandom(info.size)))
    data = whole.read_bytes()
    middle = len(data) // 2
    for number, broken in enumerate([data[:middle], data[:middle] + b"\xff" * 5000 + data[middle + 5000 :]]):
        path = tmp_path / f"{number}.tar.{ending}"
        path.write_bytes(broken)
        with suppress(UsageError):  # damage shows only where the format has a checksum; no other exception may come
            load_submission(path, steps)


def test_one_file_of_a_step_is_no_submission(tmp_path: Path, steps: list[Step]) -> None:
    path = tmp_path / "shadows.cpp"
    path.write_text("int x;\n", encoding="utf-8")
    with pytest.raises(UsageError, match=r"shadows\.cpp: is one file; expected a folder with files like steps/01-"):
        load_submission(path, steps)


def test_names_that_are_not_utf8(tmp_path: Path) -> None:
    folder = Path(os.fsdecode(os.fsencode(tmp_path) + b"/an\xffna"))
    assert submission_name(folder) == "an?na"
    assert submission_name(Path("/")) == "submission"
    assert submission_name(tmp_path / "ann\nall passed") == "ann all passed", "a name stands in one line"


def test_one_archive_in_a_folder_is_the_submission(tmp_path: Path, steps: list[Step]) -> None:
    folder = tmp_path / "Ann Lee_123_assignsubmission_file"
    folder.mkdir()
    _zip(folder / "homework.zip", {"steps/02-intersection/intersection.cpp": b"int x;"})
    (folder / "readme.txt").write_text("Here it is.")
    (folder / "._homework.zip").write_bytes(b"from macOS")
    submission = load_submission(folder, steps)
    assert (submission.name, submission.sources) == (folder.name, {"02-intersection": b"int x;"})
    (folder / "intersection.cpp").write_bytes(b"int y;")  # what lies open counts
    assert load_submission(folder, steps).sources == {"02-intersection": b"int y;"}


def test_of_two_archives_in_a_folder_none_is_chosen(tmp_path: Path, steps: list[Step]) -> None:
    for name in ("a.zip", "b.zip"):
        _zip(tmp_path / name, {"intersection.cpp": b"int x;"})
    with pytest.raises(UsageError, match="2 archives, of which none is taken"):
        load_submission(tmp_path, steps)


def test_an_archive_without_a_step_is_named(tmp_path: Path, steps: list[Step]) -> None:
    _zip(tmp_path / "essay.zip", {"essay.txt": b"Rays."})
    with pytest.raises(UsageError, match=r"holds no step, nor does essay\.zip in it"):
        load_submission(tmp_path, steps)
    (tmp_path / "essay.zip").rename(tmp_path / "essay.rar")
    (tmp_path / "essay.rar").write_bytes(b"Rar!\x1a\x07")
    with pytest.raises(UsageError, match=r"essay\.rar: is a RAR archive"):
        load_submission(tmp_path, steps)


def test_where_a_class_lies_is_not_told(tmp_path: Path, steps: list[Step]) -> None:
    (tmp_path / "secret" / "anna").mkdir(parents=True)
    (tmp_path / "secret" / "anna" / "homework.zip").write_bytes(b"PK\3\4 but no more")
    notes = load_entry("anna", ClassEntry(tmp_path / "secret" / "anna", "anna"), steps).submission.notes
    assert all("homework.zip: cannot be read" in note and "secret" not in note for note in notes.values())


@pytest.mark.parametrize(("made", "why"), [(False, "is not there any more"), (True, "is a link that leads nowhere")])
def test_an_entry_that_is_gone_is_no_zero(steps: list[Step], tmp_path: Path, *, made: bool, why: str) -> None:
    entry = tmp_path / "anna"
    if made:
        entry.symlink_to("anna")
    with pytest.raises(GraderFault, match=f"anna: {why}"):
        load_entry("anna", ClassEntry(entry, "anna"), steps)


def test_an_archive_that_is_a_link_is_not_followed(tmp_path: Path, steps: list[Step]) -> None:
    _zip(tmp_path / "another.zip", {"intersection.cpp": b"int x;"})
    (tmp_path / "anna").mkdir()
    (tmp_path / "anna" / "mine.zip").symlink_to(tmp_path / "another.zip")
    with pytest.raises(UsageError, match="holds no step; expected"):
        load_submission(tmp_path / "anna", steps)
    with pytest.raises(OSError, match="symbolic link"):
        list(archive_entries(tmp_path / "anna" / "mine.zip", may_be_link=False))


def test_a_name_that_is_nearly_right_is_answered(tmp_path: Path, steps: list[Step]) -> None:
    (tmp_path / "complete").mkdir()
    with pytest.raises(UsageError, match=r"is not there; .* did you mean complete\?"):
        load_submission(tmp_path / "complet", steps)
    with pytest.raises(UsageError, match=r"there is no folder .*/nowhere either"):
        load_submission(tmp_path / "nowhere" / "complete", steps)


@pytest.mark.parametrize(
    ("names", "held"),
    [
        (["anna/intersection.cpp", "ben/intersection.cpp"], ["anna", "ben"]),
        (
            ["2026/a/anna/steps/04-shadows/shadows.cpp", "2026/a/ben/04-shadows/shadows.cpp"],
            ["2026/a/anna", "2026/a/ben"],
        ),
        (["anna/shadows.cpp", "anna/old/04-shadows/shadows.cpp"], []),  # a copy
        (["anna/shadows.cpp", "ben/octree.cpp"], []),  # folders for steps, under names of their own
        (["shadows.cpp", "anna/shadows.cpp", "ben/shadows.cpp"], []),
    ],
)
def test_a_class_is_no_submission(tmp_path: Path, steps: list[Step], names: list[str], held: list[str]) -> None:
    for name in names:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("int x;")
    assert submissions_inside(tmp_path, steps) == held


@pytest.mark.parametrize(
    ("folder", "archives", "held"),
    [
        ("anna", ["ben.zip", "notes.zip"], []),  # told of, and graded: old.zip would be no reason not to
        (None, ["ben.zip", "cleo.zip"], ["ben.zip", "cleo.zip"]),
        (None, ["notes.zip", "ben.zip", "cleo.zip"], ["ben.zip", "cleo.zip", "notes.zip"]),
        ("ben", ["ben.zip"], []),  # unpacked beside it
        ("anna", ["notes.zip"], []),
        (None, ["ben.zip"], []),  # as platforms put a student's upload
        (".", ["ben.zip"], []),
    ],
)
def test_archives_in_a_folder_are_a_class(
    tmp_path: Path, steps: list[Step], folder: str | None, archives: list[str], held: list[str]
) -> None:
    if folder is not None:
        (tmp_path / folder / "04-shadows").mkdir(parents=True)
        (tmp_path / folder / "04-shadows" / "shadows.cpp").write_text("int x;")
    for name in archives:
        with zipfile.ZipFile(tmp_path / name, "w") as archive:
            archive.writestr("notes.txt" if name == "notes.zip" else "steps/04-shadows/shadows.cpp", "int x;")
    assert submissions_inside(tmp_path, steps) == held
    is_told_of = folder == "anna" and "ben.zip" in archives
    assert archives_beside(tmp_path, steps) == (["ben.zip"] if is_told_of else [])
