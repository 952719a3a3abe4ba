"""A page that was made from stubs may go out; one that holds a solution anywhere is refused, and the file is named."""

import argparse
import gzip
import io
import os
import tarfile
import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest
from play_pages import with_packages
from rich.console import Console

from raysteps.cli import release
from raysteps.common.errors import UsageError
from raysteps.common.text import join_and
from raysteps.course.manifest import Step, kit_steps
from raysteps.course.project import Project
from raysteps.play.packages import registry_of
from raysteps.play.play_page import PlayPage, packed
from raysteps.release.leaks import find_leaks
from raysteps.release.page_parts import Problem, archive_members, defined_symbols, look_into
from raysteps.release.secrets import Secrets, gather

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("play")]

_HOW = "only a page that was made in a students' kit may go out"
_LIBRARY = "usr/lib/wasm32-wasip1/libc.a"


@pytest.fixture(scope="module")
def secrets(project: Project) -> Secrets:
    return gather(project)


@pytest.fixture(scope="module")
def site(project: Project) -> Path:
    """The whole kit's."""
    with with_packages():
        return PlayPage(project, registry_of(None)).make()


@pytest.fixture(scope="module")
def of_students(project: Project, site: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """As a release of two steps writes it beside itself."""
    folder = tmp_path_factory.mktemp("students")
    words = ["--out", str(folder / "course"), "--steps", "1-2", "--play", str(folder / "play")]
    parser = argparse.ArgumentParser()
    release.add_arguments(parser)
    assert release.run(project, parser.parse_args(words), Console(quiet=True)) == 0
    assert {path.name for path in folder.iterdir()} == {"course", "play"}
    assert not (folder / "course" / "build").exists()
    return folder / "play"


def _unpacked(path: Path) -> dict[str, bytes]:
    with tarfile.open(path) as archive:
        return {info.name: file.read() for info in archive if (file := archive.extractfile(info)) is not None}


def _archive(members: Mapping[str, bytes]) -> bytes:
    """As ar writes it, for short names."""
    made = b"!<arch>\n"
    for name, data in members.items():
        made += (
            f"{name + '/':<16}{0:<12}{0:<6}{0:<6}{644:<8}{len(data):<10}`\n".encode() + data + b"\n" * (len(data) % 2)
        )
    return made


def _object_of(site: Path, step: Step) -> bytes:
    """The reference's, from the page of the whole kit."""
    name = f"{step.functions[0].split('::')[-1]}"
    mangled = f"{len(name)}{name}E"
    objects = [data for path, data in _unpacked(site / "kit.tar.gz").items() if path.endswith(".o")]
    (found,) = [data for data in objects if any(mangled in one for one in defined_symbols(data) if "GLOBAL" not in one)]
    return found


def _problems(name: str, data: bytes, functions: Mapping[str, str]) -> list[str]:
    return [one.text for one in look_into(name, name, data, functions) if isinstance(one, Problem)]


def test_a_page_of_stubs_may_go_out_as_a_folder_and_as_a_zip(
    secrets: Secrets, of_students: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with zipfile.ZipFile(tmp_path / "page.zip", "w") as archive:
        for path in of_students.rglob("*"):
            archive.write(path, path.relative_to(of_students.parent))
    assert release.check(secrets, tmp_path / "page.zip", Console()) == 0
    assert capsys.readouterr().out == "No solution was found in it.\n"


def test_a_page_of_a_release_has_its_steps_and_is_published(of_students: Path, steps: list[Step]) -> None:
    page = (of_students / "index.html").read_text("utf-8")
    assert "<html data-published " in page
    assert [step.id for step in steps if f'"id":"{step.id}"' in page] == [step.id for step in steps[:2]]
    assert sorted(path.name for path in (of_students / "steps").glob("*.html")) == ["01.html", "02.html"]
    assert "kit/steps/03-phong-shading/phong_shading.hpp" not in _unpacked(of_students / "system.tar.gz")


def test_a_page_of_the_whole_kit_is_refused(site: Path, project: Project, secrets: Secrets) -> None:
    found = _problems("index.html", (site / "index.html").read_bytes(), secrets.functions)
    assert found == ["the page of a whole kit, with the reference's steps; " + _HOW]
    told = _problems("kit.tar.gz", (site / "kit.tar.gz").read_bytes(), secrets.functions)
    assert sorted(told) == sorted(
        f"holds more than the stub of {join_and(sorted(step.functions))}; {_HOW}" for step in kit_steps(project)
    )


def test_what_was_planted_is_found(
    secrets: Secrets, site: Path, of_students: Path, steps: list[Step], solved: dict[str, str], tmp_path: Path
) -> None:
    """In a page without what makes it slow to search."""
    page = tmp_path / "of a course" / "play"
    for name in ("index.html", "clang.wasm.gz"):
        page.mkdir(parents=True, exist_ok=True)
        os.link(of_students / name, page / name)
    system = {name: data for name, data in _unpacked(site / "system.tar.gz").items() if name.startswith("usr/")}
    right = solved["02-intersection"].encode()
    kit = _unpacked(of_students / "kit.tar.gz")
    (page / "system.tar.gz").write_bytes(packed(system | {"kit/steps/sphere.hpp": right}))
    kit |= {"parts/one.o": _object_of(site, steps[0])}
    kit |= {"parts/a.a": _archive({"six.o": _object_of(site, steps[5]), "b.txt": right, "c": b"x"})}
    kit |= {"parts/program": b"\0asm\1\0\0\0", "parts/cut.a": kit["parts/a.a"][:-9]}
    (page / "kit.tar.gz").write_bytes(packed(kit))
    (page / "notes.txt.gz").write_bytes(gzip.compress(right))
    (page / "steps").mkdir()
    (page / "steps" / "02.pch.gz").write_bytes(gzip.compress(b"CPCH\0" + right))
    (page / "steps" / "03.pch.gz").write_bytes(gzip.compress(b"CPCH") + b"more")
    found: dict[str, str] = {}
    for leak in find_leaks(secrets, tmp_path):
        place = leak.place.removeprefix("of a course/play/")
        found[place] = f"{found.get(place, '')}\n{leak}"
    assert found.keys() == {
        "system.tar.gz, kit/steps/sphere.hpp",
        "kit.tar.gz, parts/one.o",
        "kit.tar.gz, parts/a.a, six.o",
        "kit.tar.gz, parts/a.a, b.txt",
        "kit.tar.gz, parts/a.a, c",
        "kit.tar.gz, parts/cut.a",
        "kit.tar.gz, parts/cut.a, six.o",
        "kit.tar.gz, parts/cut.a, b.txt",
        "kit.tar.gz, parts/program",
        "notes.txt.gz",
        "notes.txt.gz, unpacked",
        "steps/02.pch.gz",
        "steps/03.pch.gz",
    }
    assert "holds more than the stub of point_at, primary_ray and view_frame;" in found["kit.tar.gz, parts/one.o"]
    assert "holds more than the stub of Box::clip," in found["kit.tar.gz, parts/a.a, six.o"]
    assert "solutions/02-intersection/" in found["kit.tar.gz, parts/a.a, b.txt"]


def test_another_compiler_and_other_libraries_are_not_believed(site: Path) -> None:
    compiler = bytearray(gzip.decompress((site / "clang.wasm.gz").read_bytes()))
    compiler[-1] ^= 1
    assert _problems("clang.wasm.gz", gzip.compress(compiler, 1), {}) == ["is not the compiler that the kit knows"]
    system = _unpacked(site / "system.tar.gz")
    assert _problems("system.tar.gz", packed(system), {}) == []
    inside = look_into("system.tar.gz", "", packed(system | {_LIBRARY: system[_LIBRARY] + b"\n"}), {})
    assert _LIBRARY in {one.place.removeprefix(", ") for one in inside}, "then it is searched, and refused by its shape"
    hidden = io.BytesIO(gzip.decompress((site / "kit.tar.gz").read_bytes()) + b"more")
    found = _problems("kit.tar.gz", gzip.compress(hidden.getvalue(), 1), {})
    assert found == ["is not packed as the page packs it, or holds more"]


def test_archives_are_read_as_llvm_writes_them(site: Path) -> None:
    (archive,) = [data for name, data in _unpacked(site / "kit.tar.gz").items() if name.endswith(".a")]
    members = dict(archive_members(archive))
    assert len(members) > 20
    assert all(name.endswith(".o") and data.startswith(b"\0asm") for name, data in members.items())


def test_what_is_neither_folder_nor_zip_is_refused(secrets: Secrets, tmp_path: Path) -> None:
    (tmp_path / "a.zip").write_bytes(b"PK\3\4")
    for name in ("a.zip", "absent"):
        with pytest.raises(UsageError, match="expected the folder of a release or of a page, or a zip of one"):
            release.check(secrets, tmp_path / name, Console())
