"""The page's cache holds what this page and the last other one are made of."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from raysteps.course.project import Project
from raysteps.play import web_kit
from raysteps.play.packages import clear, written_once
from raysteps.play.web_clang import INPUT, OUTPUT, WebClang
from raysteps.play.web_kit import ObjectRequest, Source, WebKit, dependencies_of

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
    clear(tmp_path, [tmp_path / "page-3"])
    assert _cache(tmp_path) == sorted(["objects/.four.o.half", "objects/two.o", "used.json", *written])


def test_objects_of_a_few_pages_stay(tmp_path: Path) -> None:
    """For whoever makes several kinds of them, one after the other."""
    (tmp_path / "objects").mkdir()
    for number in (1, 2, 3, 4, 1, 5):
        (tmp_path / f"page-{number}").mkdir(exist_ok=True)
        (tmp_path / "objects" / f"{number}.o").touch()
        clear(tmp_path, [tmp_path / f"page-{number}", tmp_path / "objects" / str(number)])
    assert _cache(tmp_path) == ["objects/1.o", "objects/3.o", "objects/4.o", "objects/5.o", "used.json"]
    assert sorted(path.name for path in tmp_path.glob("page-*")) == ["page-1", "page-5"]


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


@pytest.fixture
def include(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the libraries' headers are."""
    include = tmp_path / "include"
    for name in ("glm/detail/type.inl", "glm/glm.hpp", "catch2/catch.hpp", "stb_image.h", "stb_image_write.h"):
        path = include / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(path.name)
    monkeypatch.setattr(web_kit, "Sources", lambda _project: _Installed(include))
    for name in ("read_all_steps", "course_steps"):
        monkeypatch.setattr(web_kit, name, lambda _project: [])
    return include


def test_another_library_is_another_folder(include: Path, tmp_path: Path) -> None:
    deep = include / "glm" / "detail" / "type.inl"

    def libraries() -> Path:
        return WebKit(Project(tmp_path), WebClang(tmp_path, tmp_path / "cache")).libraries

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


def _include(name: str) -> str:
    return f'#include "{name}.hpp"\n'


class _Clang(WebClang):
    """Makes of a source the texts of all that it includes, and tells what it has read as clang does."""

    def __init__(self, root: Path) -> None:
        super().__init__(root, root / "cache")
        self.compiled: list[str] = []

    @property
    def system(self) -> Path:
        return self.wasm.parent

    def compile_command(self, optimise: str, flags: Sequence[str], *, header: bool = False) -> list[str]:
        return [optimise, INPUT, "-o", OUTPUT]

    def make(self, words: Sequence[str], places: Mapping[str, Path]) -> None:
        source = words[1]
        self.compiled.append(source)
        read, waiting = dict[str, str](), [source]
        while waiting:
            name = waiting.pop()
            read[name] = (places["/kit"] / name.removeprefix("/kit/")).read_text()
            waiting += [f"/kit/framework/{found}" for found in re.findall(r'"(.*)"', read[name])]
        (places["/work"] / "made").write_text("".join(read.values()))
        lines = " \\\n  ".join(["/usr/include/vector", *read])
        (places["/work"] / "read").write_text(f"made: {lines}\n")


@pytest.mark.usefixtures("include")
def test_what_is_compiled_anew_has_read_what_changed(tmp_path: Path) -> None:
    project = Project(tmp_path)
    clang = _Clang(tmp_path)
    texts = {"a.cpp": _include("a"), "b.cpp": _include("b"), "a.hpp": _include("c"), "b.hpp": "b", "c.hpp": "c"}
    for name, text in texts.items():
        (tmp_path / "framework").mkdir(exist_ok=True)
        (tmp_path / "framework" / name).write_text(text)

    def made() -> tuple[list[str], list[str]]:
        """What was compiled, and the objects."""
        kit = WebKit(project, clang)
        clang.compiled.clear()
        objects = [kit._made(ObjectRequest(Source(f"framework/{name}"))) for name in ("a.cpp", "b.cpp")]
        clear(tmp_path / "cache", kit.used)
        return [name.removeprefix("/kit/framework/") for name in clang.compiled], [one.read_text() for one in objects]

    def write(name: str, text: str) -> None:
        (tmp_path / "framework" / name).write_text(text)

    assert made() == (["a.cpp", "b.cpp"], [f"{_include('a')}{_include('c')}c", f"{_include('b')}b"])
    assert made()[0] == []
    write("c.hpp", "other")
    assert made() == (["a.cpp"], [f"{_include('a')}{_include('c')}other", f"{_include('b')}b"])
    write("c.hpp", "c")
    assert made() == ([], [f"{_include('a')}{_include('c')}c", f"{_include('b')}b"]), (
        "what was made before is still there"
    )
    write("b.hpp", _include("c"))
    assert made()[0] == ["b.cpp"]
    write("c.hpp", "both")
    assert made()[0] == ["a.cpp", "b.cpp"]
    write("a.cpp", _include("b"))
    assert made()[0] == ["a.cpp"]
    write("new.hpp", "")
    assert made()[0] == []
    (tmp_path / "c.hpp").touch()
    assert made()[0] == ["a.cpp", "b.cpp"], "where it was looked for, too"


@pytest.mark.usefixtures("include")
def test_two_kits_that_take_turns_compile_nothing_anew(tmp_path: Path) -> None:
    """As a students' kit and the whole one, which share a cache: one reads a header that the other does not have."""
    (tmp_path / "framework").mkdir()
    (tmp_path / "framework" / "a.cpp").write_text(_include("a"))
    clang, compiled = _Clang(tmp_path), []
    for text in ("whole", _include("c"), "whole", _include("c")):
        (tmp_path / "framework" / "a.hpp").write_text(text)
        (tmp_path / "framework" / "c.hpp").write_text("c")
        clang.compiled.clear()
        made = WebKit(Project(tmp_path), clang)._made(ObjectRequest(Source("framework/a.cpp")))
        assert made.read_text().startswith(f"{_include('a')}{text}")
        compiled.append(len(clang.compiled))
    assert compiled == [1, 1, 0, 0]


def test_what_a_compiler_has_looked_for(tmp_path: Path) -> None:
    ray, own = tmp_path / "framework/core/ray.hpp", tmp_path / "steps/01-y/y.hpp"
    for path, text in ((ray, "#include <vector>\n"), (own, '#if __has_include("a/b.hpp")\n')):
        path.parent.mkdir(parents=True)
        path.write_text(text)
    first, second = "/parts/a.hpp /kit/framework/core/ray.hpp", "/kit/steps/02-x/../01-y/y.hpp /usr/include/cmath"
    assert dependencies_of(tmp_path, f"made: {first} \\\n  {second} \\\n /work/b\n") == [
        "a/b.hpp",
        "framework/a/b.hpp",
        "framework/absent/a/b.hpp",
        "framework/absent/vector",
        "framework/core/ray.hpp",
        "framework/core/vector",
        "framework/vector",
        "steps/01-y/a/b.hpp",
        "steps/01-y/y.hpp",
        "vector",
    ]
