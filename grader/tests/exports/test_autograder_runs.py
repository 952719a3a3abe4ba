"""The exported autograders run for real, in imitations of each system's folders. Builds the kit once more."""

import io
import json
import os
import shutil
import stat
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from raysteps.course.manifest import Step, choose
from raysteps.course.project import Project
from raysteps.exports.autograders import autolab_tar, gradescope_zip, into_folder, prairielearn_course
from raysteps.exports.formats import validate
from raysteps.play.packages import extract

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("many programs")]


def _environment(**more: str) -> dict[str, str]:
    """The Python environment of the tests stands in for the one that setup.sh would install."""
    return {**os.environ, "RAYSTEPS_VENV": sys.prefix, **more}


def _unpack(data: bytes, folder: Path) -> None:
    """As unzip does: with the modes."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        for info in archive.infolist():
            path = Path(archive.extract(info, folder))
            path.chmod(info.external_attr >> 16 & 0o777)


def _know_little(kit: Path) -> None:
    """One known mistake per step: to learn them all takes minutes, and other tests do that."""
    for path in kit.glob("solutions/*/mutants.toml"):
        mark = "[[mutants]]\n"
        head, first, *_ = path.read_text().split(mark)
        path.write_text(head + mark + first)


@pytest.fixture(scope="module")
def autograder(project: Project, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """An imitation of /autograder after setup.sh."""
    root = tmp_path_factory.mktemp("autograder")
    _unpack(gradescope_zip(project, ["--minutes", "9", "--seed", "7"]), root / "source")
    _know_little(root / "source" / "kit")
    shutil.copy(root / "source" / "run_autograder", root)
    done = subprocess.run(["sh", root / "source" / "setup.sh"], env=_environment(), capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()[-4000:]
    yield root
    shutil.rmtree(root, ignore_errors=True)


def _run_autograder(root: Path) -> tuple[int, Any]:
    environment = _environment(RAYSTEPS_AUTOGRADER=str(root))
    done = subprocess.run([root / "run_autograder"], cwd=root, env=environment, capture_output=True, check=False)
    print(done.stderr.decode("utf-8", "replace")[-4000:])  # which is why, where a test fails
    return done.returncode, json.loads((root / "results" / "results.json").read_text())


def _hand_in(root: Path, sample: Path) -> None:
    shutil.rmtree(root / "submission", ignore_errors=True)
    shutil.copytree(sample, root / "submission")


def test_gradescope(autograder: Path, project: Project) -> None:
    assert stat.S_IMODE((autograder / "source" / "kit").stat().st_mode) == 0o700
    _hand_in(autograder, project.samples / "partial")
    (autograder / "submission_metadata.json").write_text('{"users": [{"name": "Ann Lee"}]}')
    code, results = _run_autograder(autograder)
    assert code == 0
    validate(results, "gradescope")
    assert results["output"].startswith("Submitted by Ann Lee.")
    points = dict.fromkeys(range(1, 10), 0.0)
    for test in results["tests"]:
        points[int(test["number"].split(".")[0])] += test["score"]
    assert [round(points[number], 2) for number in (1, 2, 3)] == [10, 20, 15]
    assert points[4] < 10
    assert "leaderboard" not in results

    _hand_in(autograder, project.samples / "complete")
    code, results = _run_autograder(autograder)
    assert code == 0
    assert round(sum(test["score"] for test in results["tests"]), 2) == 120
    assert [entry["name"][:2] for entry in results["leaderboard"]] == ["06", "06", "09", "09"]
    work = [entry["value"] for entry in results["leaderboard"] if "work" in entry["name"]]
    assert work == [1.0, 1.0], "the sample is the reference"


def test_gradescope_reports_its_own_faults(autograder: Path, project: Project) -> None:
    _hand_in(autograder, project.samples / "partial")
    scenes, hidden = autograder / "source" / "kit" / "scenes", autograder / "source" / "scenes-gone"
    scenes.rename(hidden)
    try:
        code, results = _run_autograder(autograder)
    finally:
        hidden.rename(scenes)
    assert code == 4
    validate(results, "gradescope")
    assert not any("score" in test for test in results["tests"])

    cli = autograder / "source" / "kit" / "grader" / "src" / "raysteps" / "cli" / "app.py"
    text = cli.read_text()
    cli.write_text("broken(")
    try:
        code, results = _run_autograder(autograder)
    finally:
        cli.write_text(text)
    assert code != 0
    validate(results, "gradescope")
    assert "no score yet" in results["output"]


def test_prairielearn(autograder: Path, project: Project, steps: list[Step], tmp_path: Path) -> None:
    words, chosen = ["--minutes", "9"], ["01", "04"]
    into_folder(prairielearn_course(project, words, choose(steps, chosen), chosen, "me/raysteps"), tmp_path / "course")
    (tmp_path / "course" / "serverFilesCourse").rename(tmp_path / "serverFilesCourse")
    script = tmp_path / "serverFilesCourse" / "raysteps" / "run.sh"
    shutil.copytree(project.samples / "partial", tmp_path / "student")
    environment = _environment(RAYSTEPS_GRADE=str(tmp_path), RAYSTEPS_KIT=str(autograder / "source" / "kit"))
    done = subprocess.run([script, "--steps", *chosen], env=environment, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()
    results = json.loads((tmp_path / "results" / "results.json").read_text())
    validate(results, "prairielearn")
    assert 0.5 < results["score"] < 1
    assert [len(test["images"]) for test in results["tests"]] == [2, 3]


def test_autolab(autograder: Path, project: Project, steps: list[Step], tmp_path: Path) -> None:
    with tarfile.open(fileobj=io.BytesIO(autolab_tar(project, ["--minutes", "9", "--steps", "04"], steps))) as archive:
        extract(archive, tmp_path)
    (tmp_path / "autograde-Makefile").rename(tmp_path / "Makefile")
    (tmp_path / "hooks.rb").unlink()
    with zipfile.ZipFile(tmp_path / "handin.zip", "w") as archive:
        for path in (project.samples / "partial").rglob("*.cpp"):
            archive.write(path, path.relative_to(project.samples / "partial"))
    environment = _environment(RAYSTEPS_KIT=str(autograder / "source" / "kit"))
    done = subprocess.run(["make"], cwd=tmp_path, env=environment, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()
    *said, feedback, scores = done.stdout.decode().splitlines()
    validate([json.loads(feedback), json.loads(scores)], "autolab")
    assert 0 < json.loads(scores)["scores"]["04-shadows"] < 10
    assert "04 Shadows:" in "\n".join(said)
