"""Solutions are found wherever they hide in a release, and nothing is found where there are none."""

import json
import subprocess
import zipfile
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from raysteps.common.process import run
from raysteps.course.project import Project
from raysteps.release.build_release import write_release
from raysteps.release.leaks import Leak, find_leaks
from raysteps.release.secrets import Secrets, gather
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.updater.release_list import read_release


@pytest.fixture(scope="module")
def secrets(project: Project) -> Secrets:
    return gather(project)


@pytest.fixture(scope="module")
def solution(solved: dict[str, str]) -> str:
    """A function of step 02, as somebody might copy it."""
    text = solved["02-intersection"]
    return text[text.index("std::optional<HitRecord> closest_hit") : text.rindex("}  // namespace")]


def _only(leaks: list[Leak], place: str, beside: str = "") -> Leak:
    """All leaks are in one place; `beside` is a file that is one by itself, as nothing of its kind goes out."""
    leaks = [leak for leak in leaks if leak.place != beside]
    assert leaks, "nothing was found"
    assert {leak.place for leak in leaks} == {place}
    return leaks[0]


@pytest.mark.parametrize("parts", ["one", "all"])
def test_a_whole_release_holds_no_solution(
    kit: BuiltKit, whole_kit: BuiltKit, secrets: Secrets, tmp_path: Path, parts: str
) -> None:
    kit = whole_kit if parts == "all" else kit
    steps = list(kit.steps)
    write_release(kit, steps, "Course", tmp_path / "kit")
    assert find_leaks(secrets, tmp_path / "kit") == []
    release = read_release(tmp_path / "kit")
    assert release is not None
    assert len(release.files) > 100
    names = {file.path for file in release.files}
    assert not [name for name in names if "solutions" in name or "mutants" in name or "cases.toml" in name]
    assert {f"steps/{step.path.as_posix()}" for step in steps} <= names


def test_in_a_header(secrets: Secrets, solution: str, tmp_path: Path) -> None:
    (tmp_path / "sphere.hpp").write_text(f"#pragma once\n\n{solution}")
    leak = _only(find_leaks(secrets, tmp_path), "sphere.hpp")
    assert leak.line == 3
    assert leak.origin.startswith("solutions/02-intersection/")


def test_in_a_comment_and_in_json(secrets: Secrets, solution: str, tmp_path: Path) -> None:
    commented = "".join(f"    // {line}\n" for line in solution.splitlines())
    (tmp_path / "a.hpp").write_text(commented)
    (tmp_path / "b.json").write_text(json.dumps({"text": solution}))
    assert {leak.place for leak in find_leaks(secrets, tmp_path)} == {"a.hpp", "b.json"}


@pytest.mark.parametrize("packed", [False, True])
def test_in_what_a_picture_says(secrets: Secrets, solution: str, tmp_path: Path, packed: bool) -> None:
    said = PngInfo()
    said.add_text("Comment", solution, zip=packed)
    picture = Image.fromarray(np.zeros((4, 4, 3), dtype=np.uint8))
    picture.save(tmp_path / "right.png")
    picture.save(tmp_path / "wrong.png", pnginfo=said)
    leak = _only(find_leaks(secrets, tmp_path), f"wrong.png ({'zTXt' if packed else 'tEXt'})")
    assert leak.origin.startswith("solutions/02-intersection/")


def test_in_an_object_file(kit: BuiltKit, project: Project, secrets: Secrets, tmp_path: Path) -> None:
    source = project.solutions / "06-octree" / "octree.cpp"
    words: list[str | Path] = [kit.description.compiler, "-std=c++20", "-c"]
    words += ["-I", project.root / "framework", "-I", project.root]
    assert run([*words, source, "-o", tmp_path / "core.o"], seconds=120).code == 0
    leaks = find_leaks(secrets, tmp_path)
    _only(leaks, "core.o")
    assert any(leak.text.startswith("the symbol ") and "06-octree" in leak.origin for leak in leaks)


def test_in_an_archive(secrets: Secrets, solution: str, tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "more.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("notes/a.txt", solution)
    _only(find_leaks(secrets, tmp_path), "more.zip, notes/a.txt", beside="more.zip")


def test_in_a_history(secrets: Secrets, solution: str, tmp_path: Path) -> None:
    def git(*words: str) -> None:
        subprocess.run(["git", "-C", tmp_path, "-c", "user.name=a", "-c", "user.email=a@b.c", *words], check=True)

    (tmp_path / "a.cpp").write_text(solution)
    git("init", "--quiet", ".")
    git("add", "a.cpp")
    git("commit", "--quiet", "-m", "a")
    (tmp_path / "a.cpp").write_text("// nothing\n")
    git("commit", "--quiet", "-am", "b")
    assert {leak.place[:10] for leak in find_leaks(secrets, tmp_path)} == {".git, blob"}


def test_known_mistakes_and_hidden_cases(secrets: Secrets, project: Project, tmp_path: Path) -> None:
    for name in ("cases.toml", "mutants.toml"):
        (tmp_path / name).write_text((project.solutions / "02-intersection" / name).read_text(encoding="utf-8"))
    found = {leak.place: leak.origin for leak in find_leaks(secrets, tmp_path)}
    assert found.keys() == {"cases.toml", "mutants.toml"}


def test_what_a_student_writes_by_the_handout_is_no_leak(
    secrets: Secrets, unsolved: dict[str, str], project: Project, tmp_path: Path
) -> None:
    """Stubs, contracts and tests are public wherever they stand."""
    for number, text in enumerate(unsolved.values()):
        (tmp_path / f"{number}.txt").write_text(text)
    test = project.steps / "02-intersection" / "intersection_test.cpp"
    (tmp_path / "test.txt").write_text(test.read_text(encoding="utf-8"))
    assert find_leaks(secrets, tmp_path) == []
