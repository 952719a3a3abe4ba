"""Before the first command: the file `raysteps` in both of its languages, and what a bare machine is told."""

import ast
import shlex
import shutil
import subprocess
import sys
import threading
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from raysteps.bootstrap import start, venv
from raysteps.bootstrap.requirements import CMAKE, COMPILER, NINJA, advice, cmake_is_new_enough
from raysteps.bootstrap.venv import UNDERSTOOD, Venv, set_for
from raysteps.course.project import Project


def test_the_command_is_a_shell_script_and_a_python_program(project: Project) -> None:
    file = project.root / "raysteps"
    ast.parse(file.read_text(encoding="utf-8"))
    for shell in filter(None, map(shutil.which, ("sh", "bash"))):
        done = subprocess.run([shell, "-n", file], capture_output=True, check=False)
        assert (done.returncode, done.stderr) == (0, b"")


def test_it_needs_nothing_but_python(project: Project) -> None:
    """-S: no installed package can be seen."""
    program = "from raysteps.bootstrap.start import main; print('alone')"
    source = f"import sys; sys.path.insert(0, {str(project.root / 'grader' / 'src')!r}); {program}"
    done = subprocess.run([sys.executable, "-I", "-S", "-c", source], capture_output=True, check=False, text=True)
    assert done.stdout == "alone\n", done.stderr


def copy_of_the_command(project: Project, folder: Path) -> Path:
    """A repository with a venv that is ready; its Python prints what it is started with."""
    shutil.copy(project.root / "raysteps", folder / "raysteps")
    sources = folder / "grader" / "src" / "raysteps"
    shutil.copytree(project.root / "grader" / "src" / "raysteps" / "bootstrap", sources / "bootstrap")
    (sources / "__init__.py").touch()
    (folder / "grader" / "pyproject.toml").touch()
    venv = Venv(folder)
    venv.python.parent.mkdir(parents=True)
    otherwise = f'exec {shlex.quote(sys.executable)} "$@"'
    python = f'#!/bin/sh\ncase "$*" in *"-m raysteps"*) printf "%s|" "$@" ;; *) {otherwise} ;; esac\n'
    venv.python.write_text(python, encoding="utf-8")
    venv.python.chmod(0o755)
    program = "import sys; sys.path.insert(0, 'grader/src'); from pathlib import Path\n"
    program += "from raysteps.bootstrap.venv import Venv\n"
    program += f"venv = Venv(Path({str(folder)!r})); venv._stamp.write_text(venv._fingerprint())"
    subprocess.run([sys.executable, "-c", program], check=True, cwd=folder)
    return folder / "raysteps"


@pytest.mark.skipif(sys.platform == "win32", reason="starts a shell script")
@pytest.mark.parametrize("by_python", [False, True])
def test_words_reach_the_package_as_they_are(project: Project, tmp_path: Path, by_python: bool) -> None:
    file = copy_of_the_command(project, tmp_path.resolve())
    link = tmp_path / "linked"
    link.symlink_to(file)
    words = [sys.executable, str(link)] if by_python else [str(link)]
    given = ["check", "a b", "", "'", "ü"]
    done = subprocess.run([*words, *given], capture_output=True, check=False, text=True, cwd="/", timeout=60)
    assert done.stdout == "|".join(["-X", "utf8", "-P", "-m", "raysteps", *given, ""]), done.stderr


def test_what_takes_long_is_said_to_go_on(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(venv, "_EVERY", 0.01)
    read = "import sys; sys.stdin.read(); import time; time.sleep(0.5); sys.exit(3)"
    assert venv._run([sys.executable, "-c", read]) == 3
    assert "raysteps: still at it, for" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ("list", ""),
        ("check 01", ""),
        ("grade-class in --out out", ""),
        ("export gradescope --out a.zip", ""),
        ("bench", ""),
        ("figures --check", ""),
        ("dev new 20-fog", ""),
        ("dev", ""),
        ("", ""),
        ("play", "play"),
        ("play --no-open", "play"),
        ("play --port=8000 --registry https://npm.example.edu --out page", "play"),
        ("test --full", "dev"),
        ("test", "dev"),
        ("docs", "dev"),
        ("docs --out public", "dev"),
        ("dev lint python", "dev"),
        ("dev format", "dev"),
    ],
)
def test_only_who_tests_the_kit_needs_its_makers_packages(words: str, wanted: str) -> None:
    assert set_for(words.split()) == wanted


class _Kit:
    """A folder of a kit, and what would be installed there."""

    def __init__(self, root: Path, monkeypatch: pytest.MonkeyPatch, *folders: str) -> None:
        for name in ("grader", ".venv", *folders):
            (root / name).mkdir(parents=True)
        (root / "grader" / "pyproject.toml").touch()
        self.root = root
        self.ran: list[str] = []
        monkeypatch.setattr(start, "_set_up", lambda one, wanted: one.make(wanted))
        monkeypatch.setattr(Venv, "run", lambda one, words: 0)
        monkeypatch.setattr(venv, "_run", self._run)
        monkeypatch.setattr(Venv, "is_this", lambda one: False)
        self.understood = UNDERSTOOD
        monkeypatch.setattr(subprocess, "run", self._start)

    def _start(self, words: Sequence[str], **_: Any) -> subprocess.CompletedProcess[bytes]:
        """Its Python, which starts, or reads the words."""
        return subprocess.CompletedProcess([], 0 if words[-1] == "" else self.understood)

    def _run(self, words: Sequence[str]) -> int:
        if "venv" in words:
            (self.root / ".venv").mkdir(exist_ok=True)
            (self.root / ".venv" / "raysteps-stamp").unlink(missing_ok=True)
            self.ran.append("new")
        elif "pip" in words:
            self.ran.append(words[-1].removeprefix(str(self.root)))
        return 0

    def type(self, words: str) -> list[str]:
        """What that installs."""
        self.ran.clear()
        assert start.main(str(self.root), words.split()) == 0
        return self.ran


def test_sets_are_installed_when_they_are_first_needed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kit = _Kit(tmp_path / "kit", monkeypatch, "solutions", "tools", "grader/tests")
    assert kit.type("list") == ["new", "/grader[instructor]"]
    assert kit.type("grade a") == []
    assert kit.type("test --full") == ["/grader[dev,instructor]"]
    assert kit.type("docs") == kit.type("list") == []
    (kit.root / "grader" / "pyproject.toml").write_text("# other versions")
    assert kit.type("list") == ["new", "/grader[dev,instructor]"]


def test_help_and_wrong_words_install_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kit = _Kit(tmp_path / "kit", monkeypatch, "solutions", "tools", "grader/tests")
    for kit.understood in (2, 0):  # as what it says ends
        assert start.main(str(kit.root), ["play", "--port", "8000", "03"]) == kit.understood
        assert kit.ran == []
    kit.understood = UNDERSTOOD
    kit.type("list")
    kit.ran.clear()
    kit.understood = 2
    assert start.main(str(kit.root), ["play", "--foo"]) == 2
    assert kit.ran == []


def _read_alone(project: Project, *words: str) -> "subprocess.CompletedProcess[str]":
    """By a Python that has no packages."""
    read = "import sys; sys.path.insert(0, sys.argv.pop(1)); from raysteps.bootstrap.start import read; read()"
    python = [sys.executable, "-I", "-S", "-c", read, str(project.root / "grader" / "src")]
    return subprocess.run([*python, *words], capture_output=True, check=False, text=True)


def test_words_are_read_without_packages(project: Project) -> None:
    refused = _read_alone(project, "play", "--port", "8000", "03")
    assert (refused.returncode, refused.stdout) == (2, "")
    assert refused.stderr.endswith("'03': expected nothing more; for a step of yours type: ./raysteps watch 03\n")
    right = _read_alone(project, "play", "--port", "8000")
    assert (right.returncode, right.stdout, right.stderr) == (UNDERSTOOD, "", "")


def test_every_module_of_a_command_can_be_read_without_packages(project: Project) -> None:
    read = "import sys; sys.path.insert(0, sys.argv[1]); from raysteps.bootstrap import requirements\n"
    read += "sys.meta_path.append(requirements.AbsentPackages())\n"
    read += "from raysteps.cli import app\nparser = app.new_parser(app.here())\nprint(parser._subparsers is not None)"
    python = [sys.executable, "-I", "-S", "-c", read, str(project.root / "grader" / "src")]
    done = subprocess.run(python, capture_output=True, check=False, text=True)
    assert (done.stdout, done.stderr) == ("True\n", "")


@pytest.mark.skipif(sys.platform == "win32", reason="there are no such locks")
def test_what_another_command_sets_up_meanwhile_is_not_set_up_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kit = _Kit(tmp_path / "kit", monkeypatch, "solutions")
    one, waits = Venv(kit.root), threading.Event()
    monkeypatch.setattr(venv, "say", lambda text: waits.set() if text.startswith("waiting") else None)
    with ThreadPoolExecutor() as pool, one.alone():
        other = pool.submit(start.main, str(kit.root), ["list"])
        assert waits.wait(60)
        one.make()
        one_ran = [*kit.ran]
    assert other.result() == 0
    assert kit.ran == one_ran == ["new", "/grader[instructor]"]


def test_another_kits_packages_are_left_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    others = _Kit(tmp_path / "others", monkeypatch)
    assert others.type("list") == ["new", "/grader"]
    kit = _Kit(tmp_path / "kit", monkeypatch)
    (kit.root / ".venv").rmdir()
    try:
        (kit.root / ".venv").symlink_to(others.root / ".venv", target_is_directory=True)
    except OSError:
        pytest.skip("this user may make no links")
    assert kit.type("list") == ["new", "/grader"]
    assert not (kit.root / ".venv").is_symlink()
    assert (others.root / ".venv" / "raysteps-stamp").is_file()


def test_a_fresh_clone_is_tested_in_one_go(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kit = _Kit(tmp_path / "kit", monkeypatch, "solutions", "tools", "grader/tests")
    assert kit.type("test --full") == ["new", "/grader[dev,instructor]"]


def test_makers_keep_what_an_older_kit_installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kit = _Kit(tmp_path / "kit", monkeypatch, "solutions", "tools", "grader/tests")
    (kit.root / ".venv" / "raysteps-stamp").write_text("0123")
    assert kit.type("list") == ["new", "/grader[dev,instructor]"]


def test_students_and_autograders_get_no_more_than_they_use(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    packed = _Kit(tmp_path / "packed", monkeypatch, "solutions")
    assert packed.type("test") == ["new", "/grader[instructor]"]  # `export` must work there without a network
    students = _Kit(tmp_path / "students", monkeypatch)
    assert students.type("test") == ["new", "/grader"]
    assert students.type("play") == ["/grader[play]"]
    assert students.type("list") == students.type("play") == []


@pytest.mark.parametrize(
    ("said", "enough"),
    [("cmake version 3.22.1\n", True), ("cmake version 4.4.4", True), ("cmake version 3.9.1", False), ("", False)],
)
def test_cmake_is_asked_for_its_age(said: str, enough: bool) -> None:
    assert cmake_is_new_enough(said) is enough


def test_windows_is_told_what_to_type(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    told = advice([COMPILER, CMAKE, NINJA])
    for package in ("Kitware.CMake", "Ninja-build.Ninja", "BrechtSanders.WinLibs.POSIX.UCRT", "BuildTools"):
        assert f"winget install {package}" in told or f".{package}" in told
    assert "compiler" not in advice([CMAKE])


def test_debian_is_told_what_to_type(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(shutil, "which", lambda name: name if name == "apt-get" else None)
    assert advice([COMPILER, NINJA]).endswith("apt-get install -y g++ ninja-build")
