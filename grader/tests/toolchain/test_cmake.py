"""The build folder of the kit."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

from raysteps.common.process import Outcome
from raysteps.course.project import Project
from raysteps.toolchain import kit_artifacts
from raysteps.toolchain.cmake import BuildTree, _BuildProgress, release_tree, what_failed
from tools.selftest.programs import use_caches


def test_a_build_folder_of_another_clone_is_configured_anew(tmp_path: Path) -> None:
    project = Project(tmp_path / "clone")
    tree = BuildTree(project, "release", tmp_path / "clone" / "build", project.steps)
    (tree.folder / "CMakeFiles").mkdir(parents=True)
    cache = tree.folder / "CMakeCache.txt"
    (tree.folder / "build.ninja").touch()
    lines = f"RAYSTEPS_MINE_DIR:PATH={tree.mine}\nCMAKE_HOME_DIRECTORY:INTERNAL="
    cache.write_text(f"{lines}{project.root}\n")
    tree.forget_other_home()
    assert tree.is_configured()
    cache.write_text(f"{lines}/elsewhere\n")
    assert not tree.is_configured()
    tree.forget_other_home()
    assert not cache.exists()
    assert not (tree.folder / "CMakeFiles").exists()


_TYPE = "RelWithDebInfo"  # what the compiler knows of the folder is in what it makes only with -g
_PRESETS = {
    "version": 3,
    "configurePresets": [{"name": "release", "cacheVariables": {"CMAKE_BUILD_TYPE": _TYPE}}],
}
_LISTS = """cmake_minimum_required(VERSION 3.22)
project(tiny LANGUAGES CXX)
add_executable(tiny main.cpp)
target_include_directories(tiny PRIVATE include)
"""


def _tiny(root: Path) -> Project:
    (root / "include").mkdir(parents=True)
    (root / "CMakePresets.json").write_text(json.dumps(_PRESETS))
    (root / "CMakeLists.txt").write_text(_LISTS)
    (root / "include" / "answer.hpp").write_text("#pragma once\ninline int answer() { return 42; }\n")
    (root / "main.cpp").write_text('#include "answer.hpp"\nint main() { return answer(); }\n')
    return Project(root)


def _hits() -> int:
    done = subprocess.run(["ccache", "--print-stats"], capture_output=True, text=True, check=True)
    counted = dict(line.split("\t") for line in done.stdout.splitlines())
    return int(counted["direct_cache_hit"]) + int(counted["preprocessed_cache_hit"])


@pytest.mark.skipif(not shutil.which("ninja"), reason="needs ninja")
def test_a_launcher_that_is_gone_is_forgotten(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    launcher = tmp_path / "launcher"
    launcher.write_text('#!/bin/sh\nexec "$@"\n')
    launcher.chmod(0o755)
    tree = release_tree(_tiny(tmp_path / "kit"))
    monkeypatch.setenv("CMAKE_CXX_COMPILER_LAUNCHER", str(launcher))
    tree.configure()
    monkeypatch.delenv("CMAKE_CXX_COMPILER_LAUNCHER")
    assert tree.cached("CMAKE_CXX_COMPILER_LAUNCHER") == str(launcher)
    assert tree.is_configured()
    launcher.unlink()
    assert not tree.is_configured()
    outcome = tree.build([])
    assert outcome.code == 0, outcome.stdout + outcome.stderr
    assert tree.is_configured()


@pytest.fixture
def _cached(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With an empty cache, as `./raysteps test` uses it."""
    if not (shutil.which("ccache") and shutil.which("ninja")):
        pytest.skip("needs ccache and ninja")
    own = [name for name in os.environ if name.startswith("CCACHE_")]
    for name in (*own, "CMAKE_CXX_COMPILER_LAUNCHER", "CCACHE_DIR", "CCACHE_NOHASHDIR", "PYTHONDONTWRITEBYTECODE"):
        monkeypatch.setenv(name, "")  # so that what is set now is forgotten again
        monkeypatch.delenv(name)
    (tmp_path / "ccache.conf").touch()
    monkeypatch.setenv("CCACHE_CONFIGPATH", str(tmp_path / "ccache.conf"))
    monkeypatch.setenv("CCACHE_DIR", str(tmp_path / "cache"))
    use_caches()


@pytest.mark.usefixtures("_cached")
def test_copies_of_the_kit_share_what_was_compiled(tmp_path: Path) -> None:
    for name, hits in (("one", 0), ("far/the other", 1)):
        tree = release_tree(_tiny(tmp_path / name))
        tree.configure()
        subprocess.run(["ccache", "--zero-stats"], capture_output=True, check=True)  # CMake tries the compiler
        outcome = tree.build([])
        assert outcome.code == 0, outcome.stderr
        assert _hits() == hits


_WITH_COMPILED_HEADERS = """cmake_minimum_required(VERSION 3.22)
project(tiny LANGUAGES CXX)
set(CMAKE_BUILD_TYPE Release)
set(RAYSTEPS_MODEL reference)
set(RAYSTEPS_PRECOMPILE ON)
add_library(raysteps-flags INTERFACE)
add_library(raysteps-strict INTERFACE)
add_library(Catch2::Catch2 INTERFACE IMPORTED)
include(precompiled.cmake)
add_executable(tiny main.cpp)
target_include_directories(tiny PRIVATE framework)
raysteps_precompile(framework tiny)
"""


@pytest.mark.usefixtures("_cached")
def test_compiled_headers_are_not_those_before_a_comment_was_changed(tmp_path: Path, project: Project) -> None:
    """g++ knows a header that was compiled by its bytes, and would read it a second time."""
    tiny = _tiny(tmp_path / "kit")
    (tiny.root / "CMakeLists.txt").write_text(_WITH_COMPILED_HEADERS)
    shutil.copy(project.root / "cmake" / "precompiled.cmake", tiny.root)
    for answer, comment in enumerate(("one", "another")):
        for header in ("core/scene.hpp", "testing/testing.hpp"):
            path = tiny.root / "framework" / header
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"#pragma once\nstruct Scene {{}};  // {comment}\n")
        main = f'#include "core/scene.hpp"\nint main() {{ return Scene{{}}, {answer}; }}\n'  # has to be compiled
        (tiny.root / "main.cpp").write_text(main)
        outcome = release_tree(tiny).build([])
        assert outcome.code == 0, outcome.stdout + outcome.stderr
        shutil.rmtree(tiny.build)


@pytest.mark.parametrize(
    ("pieces", "expected"),
    [
        ([b"[1/140] Building\n[2/140] Building\n", b"[3/140] Buil"], ["2 of 140", "3 of 140"]),
        ([b"[  1%] Building\n", b"[ 26%] Built target\n"], ["1 %", "26 %"]),
        ([b"a warning[-Wall]\n"], []),
    ],
)
def test_a_build_says_how_far_it_is(pieces: list[bytes], expected: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    monkeypatch.setattr(kit_artifacts, "_EVERY", -1.0)
    how_far = _BuildProgress(said.append)
    for piece in pieces:
        how_far.heard(piece)
    assert said == expected


def test_a_build_does_not_say_it_all_the_time(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    monkeypatch.setattr(kit_artifacts, "_EVERY", 3600.0)
    how_far = _BuildProgress(said.append)
    for done in range(140):
        how_far.heard(f"[{done}/140] Building\n".encode())
    assert not said


def test_the_first_failure_is_shown_however_early_it_stands() -> None:
    early = Outcome(1, False, "a.cpp:1: error: first\n" + "x\n" * 400 + "FAILED: second\n", "", 1.0)
    assert what_failed(early).startswith("a.cpp:1: error: first\n")
    late = Outcome(1, False, "x\n" * 400 + "FAILED: second\n", "", 1.0)
    assert what_failed(late).startswith("FAILED: second")
