"""What is uploaded to other systems: archives, scripts, and which files of the kit are in them."""

import io
import os
import shutil
import stat
import subprocess
import tarfile
import zipfile
from pathlib import Path

import pytest
from export_documents import mixed
from rich.console import Console

from raysteps.cli.export import add_arguments, run
from raysteps.common.documents import as_text
from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.exports.autograders import (
    Member,
    autolab_tar,
    gradescope_zip,
    into_folder,
    kit_files,
    prairielearn_folder,
)

_WORDS = ["--minutes", "9", "--limit", "seconds=40", "--steps", "01", "it's; echo $HOME"]


def _small_kit(root: Path) -> Project:
    """Looks like a kit from outside."""
    for name in ("CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", "raysteps"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(name)
    for name in ("cmake/a.cmake", "framework/core/ray.hpp", "solutions/01-a/a.cpp", "steps/01-a/a.cpp", "scenes/a.nff"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(name)
    for name in ("src/raysteps/cli.py", "tests/test_a.py", "src/raysteps.egg-info/x", "src/raysteps/__pycache__/a.pyc"):
        (root / "grader" / name).parent.mkdir(parents=True, exist_ok=True)
        (root / "grader" / name).write_text(name)
    for name in ("docs/index.md", "build/release/x.o", ".venv/bin/python", "grades/ann/results.json", ".ci/run.sh"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(name)
    (root / "raysteps").chmod(0o755)
    return Project(root)


_EXPECTED = [
    "CMakeLists.txt",
    "CMakePresets.json",
    "LICENSE",
    "README.md",
    "cmake/a.cmake",
    "framework/core/ray.hpp",
    "grader/src/raysteps/cli.py",
    "raysteps",
    "scenes/a.nff",
    "solutions/01-a/a.cpp",
    "steps/01-a/a.cpp",
]


def _places(project: Project) -> list[str]:
    return [str(file.place) for file in kit_files(project)]


def test_the_kit_without_git(tmp_path: Path) -> None:
    project = _small_kit(tmp_path / "kit")
    (tmp_path / "kit" / "steps" / "link.cpp").symlink_to("/etc/passwd")
    assert _places(project) == _EXPECTED


def test_the_kit_with_git(tmp_path: Path) -> None:
    project = _small_kit(tmp_path / "kit")
    (project.root / ".gitignore").write_text("/build/\nscratch.txt\n")
    (project.root / "steps" / "scratch.txt").write_text("ignored")
    subprocess.run(["git", "init", "-q"], cwd=project.root, check=True)
    subprocess.run(["git", "add", "."], cwd=project.root, check=True)
    (project.root / "steps" / "09-new.cpp").write_text("not added yet")
    (project.root / "scenes" / "a.nff").unlink()
    (project.root / "scenes" / "b.nff").write_text("b")
    expected = [place for place in _EXPECTED if place != "scenes/a.nff"]
    assert _places(project) == sorted([*expected, "scenes/b.nff", "steps/09-new.cpp"])


def test_half_a_kit_is_refused(tmp_path: Path) -> None:
    project = _small_kit(tmp_path / "kit")
    shutil.rmtree(project.solutions)
    with pytest.raises(GraderFault, match="solutions is missing"):
        kit_files(project)


def test_the_real_kit_is_whole(project: Project) -> None:
    places = set(_places(project))
    assert {"raysteps", "CMakeLists.txt", "grader/pyproject.toml", "solutions/06-octree/octree.cpp"} <= places
    assert {"grader/samples/complete/steps/06-octree/octree.cpp", "grader/src/raysteps/cli/export.py"} <= places
    assert not [place for place in places if place.startswith(("docs/", "build/", "grader/tests/", ".", "bench/"))]
    for step in project.steps.glob("*/step.toml"):
        assert step.relative_to(project.root).as_posix() in places


def test_gradescope_zip(tmp_path: Path) -> None:
    project = _small_kit(tmp_path / "kit")
    data = gradescope_zip(project, _WORDS)
    assert data == gradescope_zip(project, _WORDS), "the same kit gives the same bytes"
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        modes = {info.filename: info.external_attr >> 16 for info in archive.infolist()}
        assert archive.read("run_autograder").startswith(b"#!/bin/sh\n")
        assert archive.read("kit/raysteps") == b"raysteps"
        script = archive.read("run_autograder").decode()
    assert {name for name in modes if "/" not in name} == {"setup.sh", "run_autograder"}
    assert [name for name in modes if name.startswith("kit/")] == [f"kit/{place}" for place in _EXPECTED]
    for name in ("setup.sh", "run_autograder", "kit/raysteps"):
        assert modes[name] == stat.S_IFREG | 0o755
    assert modes["kit/LICENSE"] == stat.S_IFREG | 0o644
    assert """--limit seconds=40 --steps 01 'it'"'"'s; echo $HOME'\n""" in script
    assert "@" not in script.replace('"$@"', "")


def test_autolab_tar(tmp_path: Path) -> None:
    project = _small_kit(tmp_path / "kit")
    with tarfile.open(fileobj=io.BytesIO(autolab_tar(project, _WORDS))) as outer:
        assert outer.getnames() == ["autograde-Makefile", "autograde.tar"]
        inside = outer.extractfile("autograde.tar")
        assert inside is not None
        with tarfile.open(fileobj=inside) as inner:
            modes = {info.name: info.mode for info in inner}
    assert modes["raysteps-autolab/driver.sh"] == 0o755
    assert modes["raysteps-autolab/kit/raysteps"] == 0o755
    assert "raysteps-autolab/kit/solutions/01-a/a.cpp" in modes


def test_prairielearn_folder(tmp_path: Path) -> None:
    project = _small_kit(tmp_path / "kit")
    folder = tmp_path / "serverFilesCourse" / "raysteps"
    into_folder(prairielearn_folder(project, []), folder)
    assert {path.name for path in folder.iterdir()} == {"run.sh", "setup.sh", "Dockerfile", "kit"}
    assert os.access(folder / "run.sh", os.X_OK)
    assert os.access(folder / "kit" / "raysteps", os.X_OK)
    with pytest.raises(UsageError, match="new or an empty folder"):
        into_folder([Member("a", b"")], folder)


@pytest.mark.parametrize("name", ["setup.sh", "run_autograder", "run.sh", "driver.sh"])
def test_scripts_are_shell(project: Project, tmp_path: Path, name: str) -> None:
    members = {member.name: member for member in prairielearn_folder(project, _WORDS)}
    with zipfile.ZipFile(io.BytesIO(gradescope_zip(project, _WORDS))) as archive:
        scripts = {"setup.sh": archive.read("setup.sh"), "run_autograder": archive.read("run_autograder")}
    with tarfile.open(fileobj=io.BytesIO(autolab_tar(project, _WORDS))) as outer:
        inside = outer.extractfile("autograde.tar")
        assert inside is not None
        with tarfile.open(fileobj=inside) as inner:
            driver = inner.extractfile("raysteps-autolab/driver.sh")
            assert driver is not None
            scripts["driver.sh"] = driver.read()
    scripts["run.sh"] = members["run.sh"].data
    done = subprocess.run(["sh", "-n"], input=scripts[name], capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")


def _export(project: Project, *words: str | Path) -> int:
    import argparse

    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return run(project, parser.parse_args([str(word) for word in words]), Console(file=io.StringIO()))


def test_the_command_packs(project: Project, tmp_path: Path) -> None:
    words = [
        "--require-sandbox",
        "--seed",
        "7",
        "--feedback",
        "diagnosis",
        "--limit",
        "seconds=40",
        "--steps",
        "1",
        "02",
    ]
    assert _export(project, "gradescope", "--out", tmp_path / "a.zip", "--hidden", "after_published", *words) == 0
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        script = archive.read("run_autograder").decode()
    line = next(line.strip() for line in script.splitlines() if "--run" in line)
    assert line == (
        'raysteps export gradescope --run "$root" --hidden after_published --minutes 9 --require-sandbox --seed 7 '
        "--feedback diagnosis --limit seconds=40 --steps 1 02"
    )
    assert _export(project, "autolab", "--out", tmp_path / "a.tar") == 0
    assert _export(project, "prairielearn", "--out", tmp_path / "pl") == 0
    assert _export(project, "classroom50", "--autograder", tmp_path / "autograder.py") == 0
    assert _export(project, "classroom50", "--workflow", tmp_path / "w.yaml", "--kit", "o/kit") == 0
    assert (tmp_path / "w.yaml").is_file()


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["gradescope"], "--out autograder.zip"),
        (["gradescope", "--out", "x.zip", "--steps", "99"], "no step '99'"),
        (["gradescope", "--out", "x.zip", "--limit", "speed=1"], "speed"),
        (["gradescope", "--out", "/nowhere/there/x.zip"], "cannot be written"),
        (["classroom50"], "--workflow FILE"),
        (["classroom50", "--workflow", "x.yaml"], "--kit"),
        (["gradescope", "--results", "none.json", "--out", "x"], "is not there"),
    ],
)
def test_what_makes_no_sense_is_said(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], complaint: str
) -> None:
    monkeypatch.chdir(tmp_path)
    if "/nowhere/there/x.zip" in words:
        (tmp_path / "file").write_text("")
        words = [*words[:-1], str(tmp_path / "file" / "x.zip")]
    with pytest.raises(UsageError, match=complaint):
        _export(project, *words)


@pytest.mark.parametrize("words", [["--seed", "-1"], ["--seed", "x"], ["--minutes", "0"], ["--minutes", "nan"]])
def test_odd_options_are_refused(project: Project, words: list[str]) -> None:
    with pytest.raises(SystemExit):
        _export(project, "gradescope", "--out", "x.zip", *words)


@pytest.mark.parametrize("system", ["gradescope", "classroom50", "autolab", "prairielearn"])
@pytest.mark.parametrize(
    "words", [["--seed", "7"], ["--steps", "01"], ["--limit", "seconds=2"], ["--require-sandbox"]]
)  # fmt: skip
def test_what_is_graded_already_takes_no_options_of_grading(
    project: Project, tmp_path: Path, system: str, words: list[str]
) -> None:
    with pytest.raises(UsageError, match=f"leave {words[0]} out"):
        _export(
            project, system, "--results", tmp_path / "r.json", "--out", tmp_path / "x", "--feedback", "full", *words
        )


def test_feedback_holds_for_what_is_converted(project: Project, steps: list[Step], tmp_path: Path) -> None:
    path, out = tmp_path / "results.json", tmp_path / "out.json"
    path.write_text(as_text(mixed(steps)))
    said = {}
    for feedback in ("full", "diagnosis", "score"):
        words = ("--results", path, "--out", out, "--hidden", "after_published", "--feedback", feedback)
        assert _export(project, "gradescope", *words) == 0
        said[feedback] = out.read_text()
    assert "secret input" in said["full"]
    assert "secret" not in said["diagnosis"]
    assert "origin inside" in said["diagnosis"]
    assert "origin inside" not in said["score"]
