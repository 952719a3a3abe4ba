"""Container images: what they are built from, by rules, and the command that has them built."""

import argparse
import fnmatch
import io
import json
import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace

import pytest
from rich.console import Console

import raysteps.cli.image
import raysteps.sandbox.detect
from raysteps.cli import release
from raysteps.cli.grade import _room
from raysteps.cli.image import add_arguments, run
from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.settings import COURSE_VARIABLE, read_course
from raysteps.exports.autograders import Member, grader_image, into_folder, prairielearn_course, students_image
from raysteps.release.contents import NEVER
from raysteps.release.leaks import find_leaks
from raysteps.release.secrets import gather


def _image(kind: str, project: Project, steps: list[Step], folder: Path) -> Path:
    """The folder that it is built from. The students' kit is not in it: `release` writes that."""
    if kind == "prairielearn":
        into_folder(prairielearn_course(project, [], steps, [], "me/raysteps"), folder)
        return folder / "image"
    into_folder((grader_image if kind == "grader" else students_image)(project), folder)
    if kind == "students":
        (folder / "kit").mkdir()
    return folder


@pytest.fixture(params=["grader", "students", "prairielearn"])
def context(request: pytest.FixtureRequest, project: Project, steps: list[Step], tmp_path: Path) -> Path:
    return _image(request.param, project, steps, tmp_path / "context")


def _instructions(folder: Path) -> list[tuple[str, str]]:
    """Word and rest of each, with lines that go on joined; by the reference of Dockerfiles."""
    lines = [line for line in (folder / "Dockerfile").read_text().splitlines() if not line.lstrip().startswith("#")]
    text = re.sub(r"\\\n", " ", "\n".join(lines))
    return [(line.split()[0], line.split(None, 1)[1]) for line in text.splitlines() if line.strip()]


def _runs(folder: Path) -> list[list[str]]:
    """The commands of all RUN lines."""
    commands = [part for word, rest in _instructions(folder) if word == "RUN" for part in rest.split("&&")]
    return [shlex.split(part) for part in commands]


def _is_sent(folder: Path, name: str) -> bool:
    """Whether .dockerignore lets it through: the last line that fits counts."""
    path, sent = folder / ".dockerignore", True
    for line in path.read_text().splitlines() if path.is_file() else []:
        if line and not line.startswith("#") and fnmatch.fnmatch(name, line.removeprefix("!")):
            sent = line.startswith("!")
    return sent


def test_what_is_copied_is_there(context: Path) -> None:
    copied = [rest.split() for word, rest in _instructions(context) if word == "COPY"]
    assert copied
    for *sources, target in copied:
        assert target.startswith("/opt/raysteps/")
        for source in sources:
            assert (context / source).exists()
            assert _is_sent(context, source)
    assert not [word for word, _ in _instructions(context) if word == "ADD"], "nothing is fetched by the engine"


def test_what_it_begins_with_stays_the_same(context: Path) -> None:
    beginnings = [rest for word, rest in _instructions(context) if word == "FROM"]
    assert len(beginnings) == 1
    host, _, name = beginnings[0].partition("/")
    assert host == "docker.io"
    assert re.fullmatch(r"library/debian:[a-z]+-20[0-9]{6}-slim|.*@sha256:[0-9a-f]{64}", name)


def test_every_python_package_is_pinned(context: Path) -> None:
    for words in _runs(context):
        if "pip" in words[0] or "pip" in words:
            assert words[1:3] == ["install", "--no-cache-dir"]
            assert words[3:] == ["-r", "/opt/raysteps/requirements.txt"]
    lines = (context / "requirements.txt").read_text().splitlines()
    assert all(re.match(r"[A-Za-z0-9._-]+==[0-9][^ ;]*( *;|$)", line) for line in lines)
    names = [re.sub("[-_.]+", "-", line.split("==")[0].lower()) for line in lines]
    assert len(set(names)) == len(names)
    assert {"numpy", "markupsafe", "mdurl"} <= set(names), "and what they need in turn"


def test_layers_leave_nothing_behind(context: Path) -> None:
    for word, rest in _instructions(context):
        if word == "RUN" and "apt-get" in rest:
            assert "apt-get update" in rest
            assert "--no-install-recommends" in rest
            assert rest.rstrip().endswith("rm -rf /var/lib/apt/lists/*")
    assert "@" not in (context / "Dockerfile").read_text().replace("@sha256", "")


@pytest.mark.parametrize("kind", ["grader", "students"])
def test_nobody_is_root_in_it(kind: str, project: Project, steps: list[Step], tmp_path: Path) -> None:
    found = dict(_instructions(_image(kind, project, steps, tmp_path / "context")))
    assert re.fullmatch("[1-9][0-9]*:[1-9][0-9]*", found["USER"])
    entry = json.loads(found["ENTRYPOINT"])
    assert entry[0].startswith("/")
    assert entry[-2:] == ["-m", "raysteps"], "exit codes and signals are the command's own"
    assert "org.opencontainers.image.version" in found["LABEL"]
    assert found["VOLUME"] in found["ENV"], "temporary files go where a read-only root lets them"


def test_an_image_that_grades_has_the_whole_kit_and_the_course(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = tmp_path / "course"
    (course / "rules").mkdir(parents=True)
    (course / "course.toml").write_text('seed = 77\nlate_policy = "rules/late.toml"\n[points]\n02 = 25\n')
    (course / "rules" / "late.toml").write_text("deadline = 2026-11-20T23:59:00+01:00\npercent_per_day = 10\n")
    monkeypatch.setenv(COURSE_VARIABLE, str(course / "course.toml"))
    folder = tmp_path / "context"
    into_folder(grader_image(project), folder)
    assert (folder / "kit/solutions/06-octree/octree.cpp").is_file()
    assert (folder / "kit/grader/samples/complete").is_dir()
    assert os.access(folder / "kit/raysteps", os.X_OK)
    monkeypatch.delenv(COURSE_VARIABLE)
    told = read_course(Project(folder / "kit"))
    assert told.seed == 77
    assert told.late_policy is not None
    assert told.late_policy.is_file()
    (course / "course.toml").write_text('late_policy = "../elsewhere.toml"\n')
    monkeypatch.setenv(COURSE_VARIABLE, str(course / "course.toml"))
    with pytest.raises(UsageError, match=r"course\.toml:1:1: .* beside course\.toml or below"):
        grader_image(project)


def test_students_get_nothing_of_the_solutions(project: Project, tmp_path: Path) -> None:
    folder = tmp_path / "context"
    into_folder(students_image(project), folder)
    assert release.write(project, [], None, folder / "kit", Console(quiet=True))
    secrets = gather(project)
    assert find_leaks(secrets, folder) == []
    source = folder / "kit" / "grader" / "src"
    assert (source / "raysteps" / "cli" / "check.py").is_file()
    for module in NEVER:
        place = source.joinpath(*module.split("."))
        assert not place.with_suffix(".py").exists()
        assert not (place / "__init__.py").exists()
    octree = project.solutions / "06-octree" / "octree.cpp"
    shutil.copy(octree, folder / "setup.sh")
    assert find_leaks(secrets, folder), "wherever in the context it lies"


# The command, with engines that only say what they were asked.


def _engine(folder: Path, name: str, script: str) -> None:
    folder.mkdir(exist_ok=True)
    (folder / name).write_text(f"#!/bin/sh\n{script}\n")
    (folder / name).chmod(0o755)


_DEAD = 'echo "Cannot connect to the Docker daemon" >&2; exit 1'
_ALIVE = """[ "$1" = version ] && exit 0
for word in "$@"; do last=$word; done
echo "$@" >{log}
ls -A "$last" >>{log}
exit {code}"""


def _typed(project: Project, *words: str | Path) -> tuple[int, str]:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    printed = io.StringIO()
    code = run(project, parser.parse_args([str(word) for word in words]), Console(file=printed, width=300))
    return code, printed.getvalue()


@pytest.fixture
def engines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "engines"
    folder.mkdir()
    for name in ("git", "sh", "ls"):
        (folder / name).symlink_to(str(shutil.which(name)))
    monkeypatch.setenv("PATH", str(folder))
    return folder


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    def members(project: Project, base: str) -> Sequence[Member]:
        return [Member("Dockerfile", f"FROM {base}\n".encode())]

    monkeypatch.setattr(raysteps.cli.image, "grader_image", members)


@pytest.mark.usefixtures("small")
def test_the_engine_that_answers_builds(project: Project, engines: Path, tmp_path: Path) -> None:
    log = tmp_path / "log"
    _engine(engines, "docker", _DEAD)
    _engine(engines, "podman", _ALIVE.format(log=log, code=0))
    code, said = _typed(project, "--tag", "raysteps-grader")
    assert code == 0
    words, *files = log.read_text().splitlines()
    assert words.startswith("build --tag=raysteps-grader /")
    assert files == ["Dockerfile"]
    assert not Path(words.split()[-1]).exists(), "what it was built from is gone"
    line = said.splitlines()[-1].strip()
    assert shlex.split(line)[:5] == ["podman", "run", "--rm", "--network", "none"]
    assert shlex.split(line)[-3:] == ["raysteps-grader", "grade", "/submission"]


@pytest.mark.usefixtures("small")
def test_no_engine_and_one_that_fails(project: Project, engines: Path, tmp_path: Path) -> None:
    _engine(engines, "docker", _DEAD)
    with pytest.raises(UsageError, match=r"docker does not work: Cannot connect.*podman is not installed.*--context"):
        _typed(project, "--tag", "x")
    _engine(engines, "podman", _ALIVE.format(log=tmp_path / "log", code=125))
    with pytest.raises(GraderFault, match="podman build ended with exit code 125"):
        _typed(project, "--tag", "x")


def test_only_the_files(project: Project, tmp_path: Path) -> None:
    context = tmp_path / "my context"
    code, said = _typed(project, "--context", context, "--base", "debian:trixie")
    assert code == 0
    assert f"docker build --tag NAME '{context}'" in said
    assert dict(_instructions(context))["FROM"] == "debian:trixie"
    with pytest.raises(UsageError, match="new or an empty folder"):
        _typed(project, "--context", context)
    with pytest.raises(UsageError, match="lies in the kit's own folder"):
        _typed(project, "--context", project.root / "context")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [(["--steps", "1-4"], "--steps is for"), (["--base", "a\nRUN x"], "name of an image"), (["--base", ""], "--base")],
)
def test_what_makes_no_sense_is_said(project: Project, tmp_path: Path, words: list[str], complaint: str) -> None:
    with pytest.raises(UsageError, match=complaint):
        _typed(project, "--context", tmp_path / "context", *words)


# What a kit in an image needs of the rest of the kit.


def test_a_kit_that_may_only_be_read_has_its_results_elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    project = Project(tmp_path)
    assert _room(project) == project.build
    monkeypatch.setattr("os.access", lambda path, mode: False)
    assert not _room(project).is_relative_to(tmp_path)


def test_where_no_program_may_be_run_nothing_is_graded(monkeypatch: pytest.MonkeyPatch) -> None:
    """A student's step would be blamed for it."""
    monkeypatch.setattr("os.statvfs", lambda path: SimpleNamespace(f_flag=os.ST_NOEXEC))
    with pytest.raises(UsageError, match=r"noexec.*TMPDIR"):
        raysteps.sandbox.detect.find_sandbox()


def test_the_scripts_of_an_image_are_shell(project: Project, tmp_path: Path) -> None:
    into_folder(grader_image(project), tmp_path / "context")
    for command in [rest for word, rest in _instructions(tmp_path / "context") if word == "RUN"]:
        assert subprocess.run(["sh", "-n", "-c", command], check=False).returncode == 0
    assert subprocess.run(["sh", "-n", tmp_path / "context" / "setup.sh"], check=False).returncode == 0
