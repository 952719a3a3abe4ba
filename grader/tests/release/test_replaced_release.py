"""A release in the place of an older one: the history stays and is looked through, and nothing is lost."""

import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.release import build_release as making
from raysteps.release import build_release as replacing
from raysteps.release.build_release import Leaks, PageOptions, refuse_foreign_files, release
from raysteps.release.leaks import leaks_in_history
from raysteps.release.secrets import gather
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.updater.release_list import PLACE


def _git(folder: Path, *words: str) -> str:
    command = ["git", "-C", str(folder), "-c", "user.name=a", "-c", "user.email=a@b.c", *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


@pytest.fixture(scope="module", autouse=True)
def _no_pictures() -> Iterator[None]:
    """No test here looks at those that the reference draws."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(making, "write_reference_artifacts", lambda *_: None)
        yield


@pytest.fixture(scope="module")
def spring(kit: BuiltKit, steps: list[Step], tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("spring") / "course"
    assert _released(kit, steps, out, "Spring")
    return out


@pytest.fixture
def older(spring: Path, tmp_path: Path) -> Path:
    """A release of step 01 that somebody keeps in a repository, and built."""
    out = shutil.copytree(spring, tmp_path / "out" / "course")
    _git(out, "init", "--quiet")
    _git(out, "add", ".")
    _git(out, "commit", "--quiet", "-m", "Spring")
    (out / "build").mkdir()
    (out / "build" / "notes.txt").write_text("mine", encoding="utf-8")
    return out


def _nothing(new: Path, out: Path) -> bool:
    return False


def _released(kit: BuiltKit, steps: list[Step], out: Path, course: str, leaks: Leaks = _nothing) -> bool:
    return release(kit, steps[:1], course, out, leaks, lambda text: None)


class _Page:
    """A page to work in; where it is made, CMake leaves its own folder."""

    def __init__(self, project: Project, registry: str, say: object, cache: Path) -> None:
        self._project = project
        assert registry == "https://npm.example.edu"
        assert cache.parts[-2:] == ("build", "play")

    def make(self) -> Path:
        assert (self._project.root / PLACE).is_file(), "the release is whole"
        (self._project.build / "release").mkdir(parents=True)
        made = self._project.root.parent / "made"
        made.mkdir()
        for name, text in (("index.html", "<html >"), ("offline.js", ""), ("a.js", "of the page")):
            (made / name).write_text(text, "utf-8")
        return made


@pytest.mark.parametrize("leaking", ["", "course", "made"])
def test_release_and_page_go_out_together_or_not_at_all(
    leaking: str, older: Path, kit: BuiltKit, steps: list[Step], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(making, "PlayPage", _Page)
    searched: list[str] = []

    def leaks(new: Path, _out: Path) -> bool:
        searched.append(new.name)
        assert not (new / "build").exists()
        return new.name == leaking

    page = PageOptions(tmp_path / "page", "https://npm.example.edu")
    before = (older / PLACE).read_bytes()
    written = release(kit, steps[:1], "Autumn", older, leaks, lambda text: None, page)
    assert written == (leaking == "")
    assert searched == ["course", "made"], "all leaks are told at once"
    assert ((older / PLACE).read_bytes() != before) == written
    assert (older / "build" / "notes.txt").read_text("utf-8") == "mine"
    found = {path.name: path.read_text("utf-8") for path in page.out.glob("*")}
    assert (found.pop(".raysteps-page.json", None) is not None) == written, "which says what is the page's own"
    assert found == (
        {"index.html": "<html data-published >", "offline.js": "", "a.js": "of the page"} if written else {}
    )


def test_history_and_build_stay(older: Path, kit: BuiltKit, steps: list[Step]) -> None:
    assert _released(kit, steps, older, "Autumn")
    assert "Autumn" in (older / "README.md").read_text(encoding="utf-8")
    assert _git(older, "log", "--format=%s") == "Spring\n"
    assert "README.md" in _git(older, "status", "--short")
    assert (older / "build" / "notes.txt").read_text(encoding="utf-8") == "mine"
    assert [path.name for path in older.parent.iterdir()] == ["course"]


def test_what_setting_up_leaves_does_not_stand_in_the_way(older: Path, kit: BuiltKit, steps: list[Step]) -> None:
    for name in ("grader/src/raysteps.egg-info/PKG-INFO", "scenes/__pycache__/generate.cpython-311.pyc"):
        (older / name).parent.mkdir()
        (older / name).write_bytes(b"made")
    assert _released(kit, steps, older, "Autumn")
    assert not (older / "scenes" / "__pycache__").exists()
    (older / "scenes" / "egg-information").write_bytes(b"mine")
    with pytest.raises(UsageError, match="egg-information: is not of the release"):
        refuse_foreign_files(older)


def test_a_history_that_tells_is_not_taken_over(
    older: Path, kit: BuiltKit, steps: list[Step], solved: dict[str, str]
) -> None:
    (older / "a.txt").write_text(solved["02-intersection"], encoding="utf-8")
    _git(older, "add", "a.txt")
    _git(older, "commit", "--quiet", "-m", "by mistake")
    _git(older, "rm", "--quiet", "a.txt")
    _git(older, "commit", "--quiet", "-m", "away")
    secrets = gather(kit.project)
    assert not _released(kit, steps, older, "Autumn", lambda new, out: bool(leaks_in_history(secrets, out)))
    assert "Spring" in (older / "README.md").read_text(encoding="utf-8")
    assert _git(older, "log", "--format=%s") == "away\nby mistake\nSpring\n"
    assert [path.name for path in older.parent.iterdir()] == ["course"]


def test_a_file_that_comes_while_it_is_written_stays(older: Path, kit: BuiltKit, steps: list[Step]) -> None:
    def late(new: Path, out: Path) -> bool:
        (out / "syllabus.md").write_text("mine", encoding="utf-8")
        return False

    with pytest.raises(UsageError, match=r"syllabus\.md: is not of the release"):
        _released(kit, steps, older, "Autumn", late)
    assert (older / "syllabus.md").read_text(encoding="utf-8") == "mine"
    assert "Spring" in (older / "README.md").read_text(encoding="utf-8")


def test_a_file_that_comes_at_the_last_moment_stays(
    older: Path, kit: BuiltKit, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    move = replacing._move_along

    def late(old: Path, new: Path) -> None:
        (old / "syllabus.md").write_text("mine", encoding="utf-8")
        move(old, new)

    monkeypatch.setattr(replacing, "_move_along", late)
    with pytest.raises(UsageError, match="was released, but the older one was changed meanwhile and is kept") as told:
        _released(kit, steps, older, "Autumn")
    assert "Autumn" in (older / "README.md").read_text(encoding="utf-8")
    assert _git(older, "log", "--format=%s") == "Spring\n"
    kept = re.search(r"kept: (\S+syllabus\.md):", str(told.value))
    assert kept is not None
    assert Path(kept[1]).read_text(encoding="utf-8") == "mine"


def test_an_interrupted_release_is_told(
    older: Path, kit: BuiltKit, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Killed when the older one was away and its history not yet moved along."""

    def killed(old: Path, new: Path) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(replacing, "_move_along", killed)
    with pytest.raises(KeyboardInterrupt):
        _released(kit, steps, older, "Autumn")
    with pytest.raises(UsageError, match=r"\.course-old-.*: holds what was in .*course before"):
        _released(kit, steps, older, "Autumn")
    (left,) = older.parent.glob(".course-old-*/course")
    assert _git(left, "log", "--format=%s") == "Spring\n"


def test_when_the_new_one_cannot_take_its_place_the_older_one_is_back(
    older: Path, kit: BuiltKit, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    rename = Path.rename

    def busy(path: Path, target: Path) -> Path:
        if "-new-" in path.parent.name:
            raise PermissionError(13, "a file is open")
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", busy)
    with pytest.raises(UsageError, match="cannot be written: no permission"):
        _released(kit, steps, older, "Autumn")
    assert "Spring" in (older / "README.md").read_text(encoding="utf-8")
    assert [path.name for path in older.parent.iterdir()] == ["course"]


def test_a_link_in_a_files_place_is_not_as_it_was_released(older: Path) -> None:
    (older / "LICENSE").unlink()
    (older / "LICENSE").symlink_to(older / "nowhere")
    with pytest.raises(UsageError, match="LICENSE: is not as it was released"):
        refuse_foreign_files(older)
