"""Saves are noticed, whatever an editor does and wherever the files are."""

import os
import time
from collections.abc import Iterator
from pathlib import Path
from queue import Empty, Queue

import pytest
import watchfiles
from course_fakes import save, small_project
from watch_fakes import wait_for

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.watch.events import Event, FileSaved, FileVanished, WatchNotice
from raysteps.watch.file_watcher import FileWatcher, kind_of, why_poll

_OWN = "camera_rays.cpp"


class Watched:
    """A step under watch, and what was told of it."""

    def __init__(self, project: Project, step: Step, *, poll: bool) -> None:
        self.events: Queue[Event] = Queue()
        self.path = project.steps / step.path
        self.saves = FileWatcher(project, step, self.events.put, poll=poll)

    def next(self, seconds: float = 60) -> Event:
        return self.events.get(timeout=seconds)

    def assert_quiet(self, seconds: float = 0.4) -> None:
        with pytest.raises(Empty):
            self.events.get(timeout=seconds)


@pytest.fixture
def course(tmp_path: Path) -> Project:
    """With some of the kit's own sources, which are watched from the beginning."""
    for name in ("framework/core/ray.hpp", "solutions/02-intersection/intersection.cpp"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_text("int a;")
    return small_project(tmp_path)


@pytest.fixture
def watched(request: pytest.FixtureRequest, course: Project, steps: list[Step]) -> Iterator[Watched]:
    found = Watched(course, steps[0], poll=getattr(request, "param", False))
    found.saves.start()
    time.sleep(0.2)  # until the system watches
    yield found
    found.saves.close()


@pytest.mark.parametrize("watched", [False, True], ids=["events", "polling"], indirect=True)
def test_a_save(watched: Watched) -> None:
    watched.path.write_text("int a;")
    assert watched.next() == FileSaved(_OWN)
    watched.path.write_text("int b;")
    assert watched.next() == FileSaved(_OWN)
    watched.assert_quiet()


@pytest.mark.parametrize("watched", [False, True], ids=["events", "polling"], indirect=True)
def test_a_save_by_renaming(watched: Watched) -> None:
    """As vim, Emacs and many others do: a new file takes the name."""
    new = watched.path.with_name(f".{_OWN}.swp-new")
    new.write_text("int renamed;")
    watched.path.rename(watched.path.with_name(f"{_OWN}~"))
    new.rename(watched.path)
    assert watched.next() == FileSaved(_OWN)
    watched.assert_quiet()


def test_a_burst_is_few_saves(watched: Watched, course: Project) -> None:
    for number in range(100):
        save(watched.path, f"int a = {number};")
    save(course.root / "framework" / "core" / "ray.hpp", "int last;")
    amount = 1
    while not (isinstance(found := watched.next(), FileSaved) and found.owner == "kit"):
        amount += 1
    assert amount < 10


def test_nothing_new_is_no_save(watched: Watched, steps: list[Step]) -> None:
    watched.path.write_bytes(watched.path.read_bytes())
    watched.path.chmod(0o600)
    os.utime(watched.path)
    for name in (f".{_OWN}.swp", f"{_OWN}~", "notes.txt", ".#camera_rays.cpp", "4913"):
        watched.path.with_name(name).write_text("x")
    save(watched.path.parent.with_name(steps[1].id).joinpath(steps[1].file), "another step")
    watched.assert_quiet(1.2)


@pytest.mark.parametrize("watched", [False, True], ids=["events", "polling"], indirect=True)
def test_a_file_that_goes_and_comes_back(watched: Watched) -> None:
    watched.path.unlink()
    assert watched.next() == FileVanished(_OWN)
    save(watched.path, "int back;")
    assert watched.next() == FileSaved(_OWN)


def test_the_tests_of_the_step_count_too(watched: Watched) -> None:
    save(watched.path.with_name("camera_rays_test.cpp"), "// more")
    assert watched.next() == FileSaved("steps/01-camera-rays/camera_rays_test.cpp", "kit")


@pytest.mark.parametrize("watched", [False, True], ids=["events", "polling"], indirect=True)
def test_what_the_program_is_built_from_counts_too(watched: Watched, course: Project, steps: list[Step]) -> None:
    """The student's own steps before this one, and the kit's sources; no step after it."""
    watched.saves.look_at(steps[2])
    save(watched.path, "int earlier;")
    assert watched.next() == FileSaved("steps/01-camera-rays/camera_rays.cpp", "earlier")
    save(course.steps / steps[3].path, "int later;")
    for name in ("framework/core/ray.hpp", "solutions/02-intersection/intersection.cpp"):
        save(course.root / name, "int changed;")
        assert watched.next() == FileSaved(name, "kit")
    watched.assert_quiet()


def test_many_at_once_are_one_save(watched: Watched, course: Project) -> None:
    save(course.root / "framework" / "core" / "ray.hpp", "int changed;")
    save(watched.path, "int changed;")
    if (found := watched.next()) != FileSaved("framework/core/ray.hpp and 1 more file", "kit"):
        both = {FileSaved(_OWN), FileSaved("framework/core/ray.hpp", "kit")}
        assert {found, watched.next()} == both  # where the second came only after the first was told of
    watched.assert_quiet()


def test_another_step_from_now_on(watched: Watched, course: Project, steps: list[Step]) -> None:
    watched.saves.look_at(steps[1])
    save(course.steps / steps[2].path, "int later;")
    save(course.steps / steps[1].path, "int new_one;")
    assert watched.next() == FileSaved(steps[1].file)
    watched.assert_quiet()


def test_a_folder_that_is_made_anew(watched: Watched, course: Project) -> None:
    """As when somebody switches to another branch."""
    course.steps.rename(course.root / "away")
    assert watched.next() == FileVanished(_OWN)
    (course.root / "away").rename(course.steps)
    found = [watched.next()]
    while not isinstance(found[-1], FileSaved):
        found.append(watched.next())
    save(watched.path, "int later;")
    wait_for(lambda: FileSaved(_OWN) in list(watched.events.queue))


def test_where_no_events_come_it_begins_to_poll(
    course: Project, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    modes: list[bool] = []

    def silent(*_paths: Path, force_polling: bool, **_others: object) -> Iterator[set[object]]:
        modes.append(force_polling)
        while not ended:
            time.sleep(0.05)
            yield set()

    ended: list[bool] = []
    monkeypatch.setattr(watchfiles, "watch", silent)
    found = Watched(course, steps[0], poll=False)
    found.saves.start()
    save(found.path, "int unheard;")
    assert found.next() == FileSaved(_OWN)
    told = found.next()
    assert isinstance(told, WatchNotice)
    assert "from now on files are polled" in told.text
    wait_for(lambda: modes == [False, True])
    save(course.root / "framework" / "core" / "ray.hpp", "int unheard;")  # polling may miss it as well
    assert found.next() == FileSaved("framework/core/ray.hpp", "kit")
    ended.append(True)
    found.saves.close()


def test_where_events_cannot_be_had_it_begins_to_poll(
    course: Project, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    real = watchfiles.watch

    def limited(*paths: Path, **options: bool) -> Iterator[object]:
        if not options["force_polling"]:
            raise OSError("OS file watch limit reached")
        return real(*paths, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(watchfiles, "watch", limited)
    found = Watched(course, steps[0], poll=False)
    found.saves.start()
    told = found.next()
    assert isinstance(told, WatchNotice)
    assert "OS file watch limit reached" in told.text
    time.sleep(0.7)
    save(found.path, "int seen;")
    assert found.next() == FileSaved(_OWN)
    found.saves.close()


_MOUNTS = """\
21 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw
30 21 0:31 / /mnt/c rw,noatime - 9p drvfs rw,dirsync
31 21 0:32 / /home/ann/my\\040disk rw - nfs4 server:/home rw
32 21 0:33 / /media/stick rw - fuse.sshfs ann@far rw
33 30 0:34 / /mnt/c/linux rw - tmpfs tmpfs rw
a line that is none
"""


@pytest.mark.parametrize(
    ("path", "kind", "polled"),
    [
        ("/home/ann/kit", "ext4", False),
        ("/mnt/c/Users/ann/kit", "9p", True),
        ("/home/ann/my disk/kit", "nfs4", True),
        ("/media/stick", "fuse.sshfs", True),
        ("/mnt/c/linux/kit", "tmpfs", False),
        ("/mnt/cd/kit", "ext4", False),
    ],
)
def test_the_file_system_decides(tmp_path: Path, path: str, kind: str, polled: bool) -> None:
    mounts = tmp_path / "mountinfo"
    mounts.write_text(_MOUNTS)
    assert kind_of(Path(path), mounts) == kind
    assert (kind in why_poll(Path(path), {}, mounts)) is polled


def test_the_environment_decides_first(tmp_path: Path) -> None:
    mounts = tmp_path / "mountinfo"
    mounts.write_text(_MOUNTS)
    assert why_poll(Path("/home"), {"RAYSTEPS_POLL": "1"}, mounts) == "RAYSTEPS_POLL is set"
    assert why_poll(Path("/home"), {"WATCHFILES_FORCE_POLLING": "true"}, mounts)
    assert why_poll(Path("/mnt/c/kit"), {"RAYSTEPS_POLL": "0"}, mounts) == ""
    assert why_poll(Path("/home"), {}, tmp_path / "nothing") == ""
