"""The page's cache holds what this page and the last other one are made of."""

from pathlib import Path

import pytest

from raysteps.course.project import Project
from raysteps.play import web_kit
from raysteps.play.packages import clear, written_once
from raysteps.play.web_clang import WebClang
from raysteps.play.web_kit import WebKit

pytestmark = pytest.mark.portable


def _cache(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


def test_what_was_used_now_and_before_stays(tmp_path: Path) -> None:
    for name in ("objects/one.o", "objects/one.pch.gz", "objects/two.o", "objects/three.o", "page-1/a.js", "page-2/a"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "old").touch()
    (tmp_path / "objects" / ".four.o.half").touch()
    both = [tmp_path / "page-1", tmp_path / "objects" / "one"]
    clear(tmp_path, [tmp_path / "objects" / "two", tmp_path / "page-2"])
    assert _cache(tmp_path) == ["objects/.four.o.half", "objects/two.o", "page-2/a", "used.json"]
    written = ["objects/one.o", "objects/one.pch.gz", "page-1/a.js"]
    for name in written:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    for _ in range(3):  # the same page again is no other one
        clear(tmp_path, both)
        assert _cache(tmp_path) == sorted(["objects/.four.o.half", "objects/two.o", "page-2/a", "used.json", *written])
    clear(tmp_path, [tmp_path / "objects" / "three"])
    assert _cache(tmp_path) == sorted(["objects/.four.o.half", "used.json", *written])


def test_a_folder_is_written_once(tmp_path: Path) -> None:
    folder = written_once(tmp_path / "cache", "page", {"index.html": b"1", "steps/01.html": b"2"})
    assert (folder / "steps" / "01.html").read_bytes() == b"2"
    (folder / "index.html").touch()
    before = (folder / "index.html").stat()
    assert written_once(tmp_path / "cache", "page", {"steps/01.html": b"2", "index.html": b"1"}) == folder
    assert (folder / "index.html").stat() == before
    other = written_once(tmp_path / "cache", "page", {"index.html": b"12", "steps/01.html": b""})
    assert other != folder
    assert sorted(path.name for path in (tmp_path / "cache").iterdir()) == sorted([folder.name, other.name])


class _Installed:
    """Libraries as CMake would find them."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def folders_of_others(self) -> list[Path]:
        return [self._folder]


def test_another_library_is_another_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    include = tmp_path / "include"
    deep = include / "glm" / "detail" / "type.inl"
    for path in (
        deep,
        include / "glm" / "glm.hpp",
        include / "catch2" / "catch.hpp",
        include / "stb_image.h",
        include / "stb_image_write.h",
    ):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(path.name)
    monkeypatch.setattr(web_kit, "Sources", lambda _project: _Installed(include))
    monkeypatch.setattr(web_kit, "read_all_steps", lambda _project: [])

    def libraries() -> Path:
        return WebKit(Project(tmp_path), WebClang(tmp_path, tmp_path)).libraries

    before = libraries()
    assert _cache(before) == [
        "catch2/catch.hpp",
        "glm/detail/type.inl",
        "glm/glm.hpp",
        "stb_image.h",
        "stb_image_write.h",
    ]
    assert libraries() == before
    deep.write_text("upgraded")
    after = libraries()
    assert after.name != before.name
    assert (after / "glm" / "detail" / "type.inl").read_text() == "upgraded"
    assert (before / "glm" / "detail" / "type.inl").read_text() == "type.inl"
