"""Folders that change or refuse to be read, and archives made to hang or to fill the memory."""

import bz2
import gzip
import io
import os
import resource
import socket
import struct
import subprocess
import tarfile
import tempfile
import threading
import time
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.submission import archives, entries
from raysteps.submission.load import load_submission

GOOD = "steps/04-shadows/shadows.cpp"


def _most_memory() -> int:
    """In kilobytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


@pytest.fixture(autouse=True)
def _quick() -> Iterator[None]:
    """Nothing here may compute for long, wait for ever, or take much memory."""
    start, busy, most = time.monotonic(), time.process_time(), _most_memory()
    yield
    assert time.process_time() - busy < 20
    assert time.monotonic() - start < 120  # beside other programs
    assert _most_memory() - most < 1 << 20  # beyond what tests before these took in this process


def _good(root: Path) -> Path:
    path = root / GOOD
    path.parent.mkdir(parents=True)
    path.write_text("int x;\n")
    return root


def test_links_to_folders_are_not_followed(tmp_path: Path, steps: list[Step]) -> None:
    outside = _good(tmp_path / "outside")
    inside = tmp_path / "inside"
    (inside / "steps").mkdir(parents=True)
    (inside / "octree.cpp").write_text("int x;\n")
    (inside / "steps" / "04-shadows").symlink_to(outside / "steps" / "04-shadows")
    (inside / "round").symlink_to(inside)
    (inside / "root").symlink_to("/")
    taken = load_submission(inside, steps)
    assert set(taken.sources) == {"06-octree"}
    assert taken.notes == {"04-shadows": "The folder steps/04-shadows is a link and was not followed."}


def test_a_link_to_what_is_read_anyway_is_no_matter(tmp_path: Path, steps: list[Step]) -> None:
    _good(tmp_path)
    (tmp_path / "old").mkdir()
    (tmp_path / "old" / "steps").symlink_to("../steps")
    (tmp_path / "02-intersection").symlink_to("steps/02-intersection")
    taken = load_submission(tmp_path, steps)
    assert set(taken.sources) == {Path(GOOD).parent.name}
    assert not taken.notes
    assert not taken.remarks


def test_what_is_no_file_is_named(tmp_path: Path, steps: list[Step], monkeypatch: pytest.MonkeyPatch) -> None:
    os.mkfifo(tmp_path / "shadows.cpp")
    (tmp_path / "octree.cpp").mkdir()
    (tmp_path / "refraction.cpp").symlink_to("/dev/zero")
    monkeypatch.chdir(tmp_path)  # the path of a socket may not be long
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind("reflection.cpp")
        notes = load_submission(tmp_path, steps).notes
    kinds = {"04-shadows": "pipe", "06-octree": "folder", "08-refraction": "link", "05-reflection": "socket"}
    assert set(notes) == set(kinds)
    assert all(f"is a {kind}, not a file" in notes[step] for step, kind in kinds.items())


def test_a_file_in_place_of_a_steps_folder_is_named(tmp_path: Path, steps: list[Step]) -> None:
    good = _good(tmp_path / "good")
    (good / "steps" / steps[4].id).write_text("int a;")
    notes = load_submission(good, steps).notes
    assert notes == {steps[4].id: f"steps/{steps[4].id} is a file, not a folder, and was not taken."}


def test_a_submission_that_is_neither_file_nor_folder_is_named(tmp_path: Path, steps: list[Step]) -> None:
    os.mkfifo(tmp_path / "ann")
    for place, kind in ((tmp_path / "ann", "pipe"), (Path("/dev/zero"), "device")):
        with pytest.raises(UsageError, match=f"is a {kind}; expected a submission: a folder, zip or tar$"):
            load_submission(place, steps)
    with pytest.raises(UsageError, match=r"is not there; .* did you mean ann\?"):
        load_submission(tmp_path / "anm", steps)


def test_a_link_that_leads_nowhere_is_not_said_to_be_missing(tmp_path: Path, steps: list[Step]) -> None:
    (tmp_path / "ann").symlink_to("ben")
    (tmp_path / "ben").symlink_to("ann")
    with pytest.raises(UsageError, match=r"ann: is a link that leads nowhere; expected a submission: .* tar$"):
        load_submission(tmp_path / "ann", steps)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root makes devices")
def test_devices_are_not_opened(tmp_path: Path, steps: list[Step]) -> None:
    try:
        os.mknod(tmp_path / "shadows.cpp", 0o20666, os.makedev(1, 5))
    except PermissionError:
        pytest.skip("no devices here")
    assert "is a device" in load_submission(tmp_path, steps).notes["04-shadows"]


@pytest.fixture
def for_all() -> Iterator[Path]:
    """A folder that other users can look into."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        yield Path(folder)


@contextmanager
def _as_nobody() -> Iterator[None]:
    os.setegid(54321)
    os.seteuid(54321)
    try:
        yield
    finally:
        os.seteuid(0)
        os.setegid(0)


@pytest.mark.skipif(os.geteuid() != 0, reason="takes another user's files")
def test_what_cannot_be_read_is_named(for_all: Path, steps: list[Step]) -> None:
    folder = _good(for_all / "anna")
    (folder / "octree.cpp").write_text("int x;\n")
    (folder / "octree.cpp").chmod(0)
    closed = folder / "steps" / "07-tone-mapping"
    closed.mkdir()
    closed.chmod(0)
    with _as_nobody():
        submission = load_submission(folder, steps)
    assert set(submission.sources) == {"04-shadows"}
    assert submission.notes == {
        "06-octree": "octree.cpp cannot be read (no permission) and was not taken.",
        "07-tone-mapping": "The folder steps/07-tone-mapping cannot be read.",
    }
    folder.chmod(0)
    with _as_nobody(), pytest.raises(UsageError, match="no permission"):
        load_submission(folder, steps)


def test_a_folder_that_turns_into_a_link_is_not_followed(
    tmp_path: Path, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The change happens between the look at the folder and its opening."""
    outside = _good(tmp_path / "outside")
    inside = _good(tmp_path / "inside")
    (inside / "octree.cpp").write_text("int x;\n")
    real = os.open

    def slow(path: str, flags: int, *rest: int, dir_fd: int | None = None) -> int:
        if path == "04-shadows":
            (inside / "steps" / "04-shadows").rename(tmp_path / "away")
            (inside / "steps" / "04-shadows").symlink_to(outside / "steps" / "04-shadows")
        return real(path, flags, *rest, dir_fd=dir_fd)

    monkeypatch.setattr(os, "open", slow)
    submission = load_submission(inside, steps)
    assert set(submission.sources) == {"06-octree"}
    assert submission.notes == {"04-shadows": "The folder steps/04-shadows cannot be read."}


def test_a_folder_that_changes_all_the_time(tmp_path: Path, steps: list[Step]) -> None:
    path = _good(tmp_path) / GOOD
    path.write_bytes(b"x")
    stop = threading.Event()

    def change() -> None:
        while not stop.is_set():
            for act in (
                lambda: path.write_bytes(b"x" * (1 << 18)),
                path.unlink,
                lambda: path.symlink_to("/etc/passwd"),
                path.unlink,
                lambda: os.mkfifo(path),
                path.unlink,
                path.touch,
            ):
                act()

    thread = threading.Thread(target=change)
    thread.start()
    try:
        for _ in range(200):
            # Now and then it is gone at that moment, and then nothing is left.
            with suppress(UsageError):
                assert set(load_submission(tmp_path, steps).sources.get("04-shadows", b"")) <= set(b"x")
    finally:
        stop.set()
        thread.join()


def test_a_file_without_end_is_not_read_to_its_end(tmp_path: Path, steps: list[Step]) -> None:
    path = _good(tmp_path) / GOOD
    with path.open("wb") as file:
        file.truncate(1 << 40)
    assert "larger than 1 MB" in load_submission(tmp_path, steps).notes["04-shadows"]


def test_deep_folders_are_left_alone(tmp_path: Path, steps: list[Step]) -> None:
    _good(tmp_path)
    handle = os.open(tmp_path, os.O_RDONLY)
    for _ in range(50):  # a path longer than the system takes
        os.mkdir("d" * 200, dir_fd=handle)
        below = os.open("d" * 200, os.O_RDONLY, dir_fd=handle)
        os.close(handle)
        handle = below
    os.close(handle)
    try:
        assert set(load_submission(tmp_path, steps).sources) == {"04-shadows"}
    finally:
        subprocess.run(["rm", "-rf", str(tmp_path / ("d" * 200))], check=True)


@pytest.mark.parametrize("how", [0x01, 0x41], ids=["weakly", "strongly"])
def test_an_encrypted_zip_is_refused(tmp_path: Path, steps: list[Step], how: int) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("shadows.cpp", "int x;")
    data = bytearray(path.read_bytes())
    data[6] |= how  # the flags in the file's own header
    data[data.index(b"PK\x01\x02") + 8] |= how  # and in the directory
    path.write_bytes(data)
    with pytest.raises(UsageError, match="encrypted"):
        load_submission(path, steps)


def test_a_damaged_zip_is_refused(tmp_path: Path, steps: list[Step]) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("shadows.cpp", os.urandom(2000).hex())
    data = bytearray(path.read_bytes())
    data[500] ^= 0xFF
    path.write_bytes(data)
    with pytest.raises(UsageError, match="cannot be read"):
        load_submission(path, steps)


@pytest.mark.parametrize(("start", "kind"), [(b"Rar!\x1a\x07", "RAR"), (b"7z\xbc\xaf\x27\x1c", "7z")])
def test_other_archives_are_named(tmp_path: Path, steps: list[Step], start: bytes, kind: str) -> None:
    (tmp_path / "a.zip").write_bytes(start + bytes(100))
    with pytest.raises(UsageError, match=f"is a {kind} archive; hand in"):
        load_submission(tmp_path / "a.zip", steps)


def test_a_zip_with_a_huge_directory_is_refused(tmp_path: Path, steps: list[Step]) -> None:
    path = tmp_path / "a.zip"
    size = 40 << 20
    with path.open("wb") as file:
        file.truncate(size)
        file.seek(size)
        file.write(struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, 0xFFFF, 0xFFFF, size, 0, 0))
    with pytest.raises(UsageError, match="hand in the steps only"):
        load_submission(path, steps)


def test_a_zip_of_overlapping_files_is_refused(
    tmp_path: Path, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    """One compressed block that a thousand names share: 300 MB from 350 kB."""
    with zipfile.ZipFile(tmp_path / "one.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("shadows.cpp", bytes(300_000))
    data = (tmp_path / "one.zip").read_bytes()
    start, end = data.index(b"PK\x01\x02"), data.index(b"PK\x05\x06")
    directory = data[start:end] * 1000
    tail = struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, 1000, 1000, len(directory), start, 0)
    (tmp_path / "a.zip").write_bytes(data[:start] + directory + tail)
    with pytest.raises(UsageError, match="unpack"):
        load_submission(tmp_path / "a.zip", steps)


def _endless(pack: Callable[[bytes], bytes]) -> bytes:
    """A tar with one file, compressed until little is left of it."""
    plain = io.BytesIO()
    with tarfile.open(fileobj=plain, mode="w") as archive:
        info = tarfile.TarInfo("zeros")
        info.size = 64 << 20
        archive.addfile(info, io.BytesIO(bytes(info.size)))
    return pack(plain.getvalue())


@pytest.mark.parametrize("pack", [lambda data: gzip.compress(data, 1), bz2.compress], ids=["gz", "bz2"])
def test_a_tar_that_grows_is_stopped(tmp_path: Path, steps: list[Step], pack: Callable[[bytes], bytes]) -> None:
    (tmp_path / "a.tar").write_bytes(_endless(pack))
    with pytest.raises(UsageError, match="200 times its size"):
        load_submission(tmp_path / "a.tar", steps)


def _header(name: str, size: bytes, kind: bytes = b"0") -> bytes:
    header = name.encode().ljust(100, b"\0") + b"0000644\0" + b"0000000\0" * 2 + size.ljust(12, b"\0")[:12]
    header += b"00000000000\0" + b" " * 8 + kind + b"\0" * 100 + b"ustar\x0000"
    header = header.ljust(512, b"\0")
    return header[:148] + f"{sum(header):06o}\0 ".encode() + header[156:]


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("a size below zero", _header("a", b"\xff" + b"\xff" * 10 + b"\x01") * 2),
        ("a size without end", _header("a", b"\x80" + b"\x7f" * 11)),
        (
            "a pax record that says a negative size",
            _header("a", b"00000000023\0", b"x") + b"19 size=-1000000\n".ljust(512, b"\0"),
        ),
        (
            "a pax record of no length",
            _header("a", b"00000000010\0", b"x") + b"0 a=b\n".ljust(512, b"\0") + _header("a", b"0"),
        ),
        ("a header cut short", _header("a", b"00000000000\0") + b"abc"),
        ("a header that is damaged", _header("a", b"00000000000\0") + b"x" * 512),
    ],
)
def test_tars_made_to_hang(tmp_path: Path, steps: list[Step], name: str, data: bytes) -> None:
    (tmp_path / "a.tar").write_bytes(data + bytes(1024))
    with pytest.raises(UsageError):
        load_submission(tmp_path / "a.tar", steps)


def test_headers_within_headers_without_end(tmp_path: Path, steps: list[Step]) -> None:
    one = _header("././@LongLink", b"00000000004\0", b"L") + b"abc\0".ljust(512, b"\0")
    (tmp_path / "a.tar").write_bytes(one * 5000)
    with pytest.raises(UsageError):
        load_submission(tmp_path / "a.tar", steps)


def _pax(kind: bytes, records: list[bytes]) -> bytes:
    data = b"".join(b"%d %s\n" % (len(one) + (4 if len(one) < 96 else 5), one) for one in records)
    return _header("pax", b"%011o\0" % len(data), kind) + data + bytes(-len(data) % 512)


def _holes(count: int) -> bytes:
    """A file of that many holes, in the form of PAX 1.0: where they are stands before its data."""
    told = b"%d\n" % count + b"0\n0\n" * count
    told += bytes(-len(told) % 512)
    records = [b"GNU.sparse.major=1", b"GNU.sparse.minor=0", b"GNU.sparse.name=" + GOOD.encode()]
    records.append(b"GNU.sparse.realsize=0")
    return _pax(b"x", records) + _header("sparse", b"%011o\0" % len(told)) + told


def _old_holes(blocks: int) -> bytes:
    """The same as GNU's tar wrote it before: in blocks that each say whether another one follows."""
    header = bytearray(_header(GOOD, b"00000000000\0", b"S"))
    header[482:483], header[148:156] = b"\1", b" " * 8
    header[148:156] = f"{sum(header):06o}\0 ".encode()
    told = bytearray((b"00000000001\0" * 42).ljust(512, b"\1"))
    return bytes(header) + bytes(told) * (blocks - 1) + bytes(told[:504]).ljust(512, b"\0")


@pytest.mark.parametrize("make", [_holes, _old_holes])
def test_a_file_with_a_million_holes_is_refused(
    tmp_path: Path, steps: list[Step], make: Callable[[int], bytes]
) -> None:
    """Two megabytes of a compressed tar kept the library busy for minutes, and took a gigabyte."""
    honest = _header("octree.cpp", b"00000000007\0") + b"int x;\n".ljust(512, b"\0")
    (tmp_path / "a.tar").write_bytes(make(100) + honest + bytes(1024))
    assert load_submission(tmp_path / "a.tar", steps).sources["06-octree"] == b"int x;\n"
    (tmp_path / "a.tar").write_bytes(make(100_000) + honest + bytes(1024))
    with pytest.raises(UsageError, match="impossible size"):
        load_submission(tmp_path / "a.tar", steps)


def test_headers_for_all_entries_are_few(tmp_path: Path, steps: list[Step]) -> None:
    """The library copies them for each entry."""
    honest = _header("octree.cpp", b"00000000007\0") + b"int x;\n".ljust(512, b"\0")
    (tmp_path / "a.tar").write_bytes(_pax(b"g", [b"comment=0123456789abcdef"]) + honest + bytes(1024))
    assert load_submission(tmp_path / "a.tar", steps).sources["06-octree"] == b"int x;\n"
    many = [_pax(b"g", [b"keyword-%d=" % (1000 * part + at) for at in range(100, 1000)]) for part in range(2)]
    files = _header("a", b"00000000000\0")
    (tmp_path / "a.tar").write_bytes(many[0] + files + many[1] + files + honest + bytes(1024))
    with pytest.raises(UsageError, match="too many headers"):
        load_submission(tmp_path / "a.tar", steps)


def test_an_archive_that_takes_long_is_given_up(
    tmp_path: Path, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever it is that keeps a library busy: here entries in a folder of tools, which do not count as files."""
    monkeypatch.setattr(archives, "_MAX_SECONDS", 0.2)
    files = _header("build/a", b"00000000000\0")
    (tmp_path / "a.tar").write_bytes(files * 50_000 + bytes(1024))
    with pytest.raises(UsageError, match="takes too long"):
        load_submission(tmp_path / "a.tar", steps)
    (tmp_path / "a.tar.gz").write_bytes(gzip.compress(b"") * 200_000)
    with pytest.raises(UsageError, match="takes too long"):
        load_submission(tmp_path / "a.tar.gz", steps)


def test_a_tar_with_a_zip_at_its_end_is_a_tar(tmp_path: Path, steps: list[Step]) -> None:
    """Which is what whoever looks into it sees; such as the zip of last week that lies beside the steps."""
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as archive:
        archive.writestr("shadows.cpp", "another;")
    with tarfile.open(tmp_path / "a.tar", "w") as tar:
        for name, data in (("shadows.cpp", b"int x;\n"), ("z.zip", inner.getvalue())):
            info = tarfile.TarInfo(name)
            info.size = len(data)
            tar.addfile(info, io.BytesIO(data))
    assert load_submission(tmp_path / "a.tar", steps).sources == {"04-shadows": b"int x;\n"}


def test_archives_within_archives_are_not_opened(tmp_path: Path, steps: list[Step]) -> None:
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as archive:
        archive.writestr("shadows.cpp", "int x;")
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("inner.zip", inner.getvalue())
        archive.writestr("octree.cpp", inner.getvalue())
    submission = load_submission(tmp_path / "a.zip", steps)
    assert not submission.sources
    assert "zip archive" in submission.notes["06-octree"]


def test_a_file_at_a_lesser_place_is_better_than_a_link(tmp_path: Path, steps: list[Step]) -> None:
    (tmp_path / "steps" / "04-shadows").mkdir(parents=True)
    (tmp_path / GOOD).symlink_to("/etc/passwd")
    (tmp_path / "shadows.cpp").write_text("int x;\n")
    submission = load_submission(tmp_path, steps)
    assert submission.sources == {"04-shadows": b"int x;\n"}
    assert not submission.notes
    assert submission.remarks == {"04-shadows": f"{GOOD} is a link, not a file, and was not taken."}


def test_a_crowd_in_one_folder_is_refused(tmp_path: Path, steps: list[Step], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(entries, "MAX_ENTRIES", 100)
    _good(tmp_path)
    for number in range(101):
        (tmp_path / f"{number}").touch()
    with pytest.raises(UsageError, match="more than 100 files"):
        load_submission(tmp_path, steps)
