"""What is uploaded to other systems: archives, scripts, and which files of the kit are in them."""

import io
import json
import os
import re
import shutil
import stat
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterable
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, packages_distributions, requires
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
    prairielearn_course,
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
    (root / "grader" / "pyproject.toml").write_text(
        '[project]\ndependencies = ["numpy==2.4.6"]\noptional-dependencies.instructor = ["jsonschema==4.26.0"]\n'
    )
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
    "grader/pyproject.toml",
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


def _unpacked(data: bytes) -> dict[str, tuple[bytes, int]]:
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        return {info.name: (file.read(), info.mode) for info in archive if (file := archive.extractfile(info))}


def test_autolab_tar(tmp_path: Path, steps: list[Step]) -> None:
    outer = _unpacked(autolab_tar(_small_kit(tmp_path / "kit"), _WORDS, steps[:2]))
    assert set(outer) == {"autograde-Makefile", "autograde.tar", "hooks.rb"}
    inner = _unpacked(outer["autograde.tar"][0])
    assert inner["raysteps-autolab/driver.sh"][1] == 0o755
    assert inner["raysteps-autolab/kit/raysteps"][1] == 0o755
    assert "raysteps-autolab/kit/solutions/01-a/a.cpp" in inner
    assert b'{"scores": {"01-camera-rays": null, "02-intersection": null}}' in outer["autograde-Makefile"][0]


def _course(project: Project, steps: list[Step], *chosen: str) -> dict[str, Member]:
    members = prairielearn_course(project, _WORDS, steps, chosen, "me/raysteps")
    return {member.name: member for member in members}


def test_what_is_added_to_a_course_of_prairielearn(tmp_path: Path, steps: list[Step]) -> None:
    project = _small_kit(tmp_path / "kit")
    members = _course(project, steps)
    bundle = "serverFilesCourse/raysteps"
    assert set(members) == {
        "questions/raysteps/info.json",
        "questions/raysteps/question.html",
        *(f"{bundle}/{name}" for name in ("run.sh", "prepare.sh", "setup.sh", "kit.tar")),
        "image/Dockerfile",
        "image/requirements.txt",
    }
    kit = _unpacked(members[f"{bundle}/kit.tar"].data)
    assert list(kit) == [f"kit/{place}" for place in _EXPECTED]
    assert kit["kit/raysteps"][1] == 0o755
    assert "questions/raysteps-02-04/info.json" in _course(project, [steps[1], steps[3]], "02", "04")
    with pytest.raises(UsageError, match="--image"):
        prairielearn_course(project, [], steps, [], "")
    into_folder(list(members.values()), tmp_path / "out")
    assert os.access(tmp_path / "out" / bundle / "run.sh", os.X_OK)
    with pytest.raises(UsageError, match="new or an empty folder"):
        into_folder([Member("a", b"")], tmp_path / "out")


def test_the_image_for_prairielearn_holds_no_file_of_the_kit(tmp_path: Path, steps: list[Step]) -> None:
    """Its registry is public."""
    image = {name: member.data.decode() for name, member in _course(_small_kit(tmp_path / "kit"), steps).items()}
    copied = [line for line in image["image/Dockerfile"].splitlines() if line.startswith(("COPY", "ADD"))]
    assert copied == ["COPY requirements.txt /opt/raysteps/"]
    assert image["image/requirements.txt"].splitlines()[:2] == ["numpy==2.4.6", "jsonschema==4.26.0"]
    assert " g++ " in image["image/Dockerfile"]


def _with_what_they_need(names: Iterable[str]) -> set[str]:
    found: set[str] = set()
    left = list(names)
    while left:
        name = re.split(r"[^\w.-]", left.pop())[0].lower()
        if name not in found:
            found.add(name)
            with suppress(PackageNotFoundError):  # for another system
                left += [word for word in requires(name) or [] if "extra ==" not in word]
    return found


def test_the_image_for_prairielearn_has_the_packages_that_grading_imports(project: Project, steps: list[Step]) -> None:
    words = "import sys, raysteps.cli.export, raysteps.cli.grade; print(*sys.modules)"
    sources = project.root / "grader" / "src"
    done = subprocess.run([sys.executable, "-c", words], cwd=sources, capture_output=True, text=True, check=True)
    packages = packages_distributions()
    own = {"raysteps", "_distutils_hack"}  # the latter comes with an install that can be edited
    imported = {name.partition(".")[0] for name in done.stdout.split()} - own
    needed = {name.lower() for module in imported for name in packages.get(module, [])}
    assert {"numpy", "jsonschema"} <= needed
    listed = _course(project, steps)["image/requirements.txt"].data.decode().splitlines()
    assert needed <= _with_what_they_need(listed)


def test_scripts_are_shell(project: Project, steps: list[Step]) -> None:
    course = _course(project, steps)
    with zipfile.ZipFile(io.BytesIO(gradescope_zip(project, _WORDS))) as archive:
        scripts = {"setup.sh": archive.read("setup.sh"), "run_autograder": archive.read("run_autograder")}
    inner = _unpacked(_unpacked(autolab_tar(project, _WORDS, steps))["autograde.tar"][0])
    scripts["driver.sh"] = inner["raysteps-autolab/driver.sh"][0]
    scripts |= {name: course[f"serverFilesCourse/raysteps/{name}"].data for name in ("run.sh", "prepare.sh")}
    for script in scripts.values():
        done = subprocess.run(["sh", "-n"], input=script, capture_output=True, check=False)
        assert (done.returncode, done.stderr) == (0, b"")
        assert b"@" not in script.replace(b'"$@"', b"")


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
    assert _export(project, "prairielearn", "--out", tmp_path / "pl", "--image", "me/raysteps", *words) == 0
    info = json.loads((tmp_path / "pl" / "questions" / "raysteps-01-02" / "info.json").read_text())
    assert info["externalGradingOptions"]["entrypoint"][1:] == ["--steps", "01", "02"]
    assert "--steps" not in (tmp_path / "pl" / "serverFilesCourse" / "raysteps" / "run.sh").read_text()
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
        (["prairielearn", "--out", "x"], "--image"),
        (["prairielearn", "--out", "x", "--image", "me/x", "--minutes", "10"], "--minutes 9.5 or less"),
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
