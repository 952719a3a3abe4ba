"""Which sandbox is taken, what becomes of it when the grader is killed, and what an ordinary user gets."""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from sandboxes import Misbehave, any_sandbox, hostile, misbehave, processes_running, sandbox_named
from watch_fakes import is_running, wait_for

from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.project import here
from raysteps.sandbox import detect as choice
from raysteps.sandbox import task_dir as workplace
from raysteps.sandbox.bubblewrap import Bubblewrap
from raysteps.sandbox.detect import VARIABLE, find_sandbox
from raysteps.sandbox.namespaces import hidden_folders, visible_folders
from raysteps.sandbox.task import Input, Output, Sandbox, Task
from raysteps.sandbox.users import can_lend_users, has_rights_of_root, lent_user

__all__ = ["any_sandbox", "hostile", "misbehave"]  # pytest finds fixtures by name
_NOBODY = 65534


def test_the_strongest_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    assert find_sandbox().isolation == sandbox_named("bubblewrap").isolation
    assert find_sandbox(require=True).isolation.strong


@pytest.mark.parametrize("name", ["fallback", "none"])
def test_what_is_weak_can_be_refused(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    assert not sandbox_named(name).isolation.strong
    monkeypatch.setenv(VARIABLE, name)
    with pytest.raises(UsageError, match="strong sandbox is required"):
        find_sandbox(require=True)


def test_an_unknown_choice_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, "jail")
    with pytest.raises(UsageError, match="'jail'; it may be bubblewrap, fallback, none"):
        find_sandbox()


def test_a_machine_without_bubblewrap(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr(choice, "_bubblewrap", lambda: (None, "it is not installed."))
    monkeypatch.setattr(choice, "_fallback", lambda: (None, "the kernel is too old."))
    assert find_sandbox().isolation.name == "limits only"
    with pytest.raises(UsageError, match="it is not installed"):
        find_sandbox(require=True)
    monkeypatch.setenv(VARIABLE, "fallback")
    with pytest.raises(UsageError, match="the kernel is too old"):
        find_sandbox()


def test_a_bubblewrap_that_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """As in most containers."""
    refused = tmp_path / "bwrap"
    refused.write_text("#!/bin/sh\necho 'bwrap: No permissions to create a new namespace' >&2\nexit 1\n")
    refused.chmod(0o755)
    monkeypatch.setattr(
        shutil, "which", lambda name, which=shutil.which: str(refused) if name == "bwrap" else which(name)
    )
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr(choice, "_bubblewrap", lambda: choice._try(Bubblewrap))
    assert find_sandbox().isolation.name != "bubblewrap"
    with pytest.raises(UsageError, match=r"(?i)permission"):
        find_sandbox(require=True)


def test_a_bubblewrap_that_ends_early_holds_nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its child waits for it for ever, and has what it says as an open file."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        program = Path(folder, "bwrap")
        closing = "for file in /proc/$BASHPID/fd/*; do ((${file##*/} <= 2)) || eval exec ${file##*/}'>&-'; done"
        left = f"({closing}; exec sleep 1000) & echo $! was left >&2"
        program.write_text(f"#!/bin/bash\n[ $1 = --help ] || {{ {left}; }}\n")
        program.chmod(0o755)
        monkeypatch.setattr(
            shutil, "which", lambda name, which=shutil.which: str(program) if name == "bwrap" else which(name)
        )
        with pytest.raises(GraderFault, match="was left") as raised:
            Bubblewrap().run(Task(("/bin/true",)))
    child = int(re.findall(r"(\d+) was left", str(raised.value))[0])
    wait_for(lambda: not is_running(child))


def test_folders_of_killed_graders_are_swept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    old = time.time() - 3600
    with workplace.fresh_task_dir(None):
        living = next(tmp_path.iterdir())
        abandoned = tmp_path / "raysteps-run-abandoned"
        young = tmp_path / "raysteps-run-young"
        for folder in (abandoned, young):
            (folder / "out").mkdir(parents=True)
        link = tmp_path / "raysteps-run-link"
        link.symlink_to(living)
        os.utime(link, (old, old), follow_symlinks=False)
        for folder in (living, abandoned):
            os.utime(folder, (old, old))
        workplace.sweep()
        assert living.exists()
        assert young.exists()
        assert not abandoned.exists()
    assert not living.exists()


@pytest.fixture
def readable_folder() -> Iterator[Path]:
    """A folder among the system's libraries that stands for a kit that was installed there."""
    for folder in sorted(Path("/usr/lib").iterdir()):
        if folder.is_dir() and not folder.is_symlink() and "-linux-" not in folder.name:
            files = [path for path in folder.iterdir() if path.is_file() and os.access(path, os.R_OK)]
            if any(path.stat().st_size for path in files):
                yield folder
                return
    pytest.skip("no folder in /usr/lib has a file")


def test_a_kit_among_the_libraries_is_masked(hostile: Path, readable_folder: Path) -> None:
    file = next(path for path in readable_folder.iterdir() if path.is_file() and path.stat().st_size)
    task = Task((Input(hostile), "read", str(file)))
    sandbox_named("bubblewrap")
    assert Bubblewrap().run(task).outcome.code == 0
    assert Bubblewrap((readable_folder,)).run(task).outcome.code == 1


def test_an_older_bubblewrap(hostile: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without limits for scratch, a program gets none; a compiler gets it all the same."""
    sandbox_named("bubblewrap")
    older = Bubblewrap()
    monkeypatch.setattr(older, "_options", frozenset())
    assert older.run(Task((Input(hostile), "fill", "/tmp"))).outcome.stdout == "0\n"
    assert older.run(Task((Input(hostile), "write", Output("a"), "1"))).outputs["a"]
    (tmp_path / "a.cpp").write_text("int a;\n")
    task = Task(("c++", "-c", Input(tmp_path / "a.cpp"), "-o", Output("a.o")), tools=True)
    assert older.run(task).outputs["a.o"]


def test_hidden_folders(tmp_path: Path) -> None:
    (tmp_path / "include" / "catch2").mkdir(parents=True)
    (tmp_path / "include" / "kit").mkdir()
    (tmp_path / "elsewhere").mkdir()
    hidden = hidden_folders([tmp_path / "include"], [tmp_path / "include" / "kit", tmp_path / "elsewhere"])
    assert hidden == [tmp_path / "include" / "catch2", tmp_path / "include" / "kit"]


def test_a_compiler_elsewhere_brings_its_folders(tmp_path: Path) -> None:
    for name in ("bin", "lib", "libexec", "share"):
        (tmp_path / name).mkdir()
    seen = visible_folders(tmp_path / "bin" / "g++")
    assert [path.name for path in seen if path.is_relative_to(tmp_path)] == ["lib", "bin", "libexec"]
    assert Path("/usr/lib") in visible_folders(None)
    assert Path("/usr/bin") not in visible_folders(None)


def test_users_are_lent_once() -> None:
    with lent_user() as one, lent_user() as two:
        assert one != two


def test_two_at_once(any_sandbox: Sandbox, misbehave: Misbehave) -> None:
    seen: list[bytes | None] = []

    def work() -> None:
        for _ in range(5):
            seen.append(misbehave(any_sandbox, "write", Output("a"), "1").outputs.get("a"))

    workers = [threading.Thread(target=work) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert seen == [b"x" * (1 << 20)] * 20


@pytest.mark.parametrize(
    ("name", "way"),
    [("bubblewrap", "stubborn"), ("bubblewrap", "bomb"), ("fallback", "stubborn"), ("fallback", "bomb"),
     ("none", "stubborn")],
)  # fmt: skip
def test_a_killed_grader_leaves_nothing(name: str, way: str, hostile: Path) -> None:
    sandbox_named(name)
    code = (
        "import sys\nfrom pathlib import Path\nfrom raysteps.sandbox.detect import find_sandbox\n"
        "from raysteps.sandbox.task import Input, Limits, Task\n"
        "limits = Limits(wall_seconds=30, processes=10)\n"
        "find_sandbox().run(Task((Input(Path(sys.argv[1]), sys.argv[3]), sys.argv[2]), limits))\n"
    )
    orphan = f"orphan-{os.getpid()}"
    environment = {**os.environ, VARIABLE: name}
    with subprocess.Popen([sys.executable, "-c", code, str(hostile), way, orphan], env=environment) as grader:
        until = time.monotonic() + 60
        while not processes_running(orphan) and time.monotonic() < until:
            time.sleep(0.05)
        assert processes_running(orphan)
        grader.send_signal(signal.SIGKILL)
    until = time.monotonic() + 60
    while processes_running(orphan) and time.monotonic() < until:
        time.sleep(0.05)
    assert processes_running(orphan) == []


def _python_for_others() -> list[str]:
    """An interpreter of the same version that the user nobody can start."""
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    for name in (sys.executable, f"/usr/bin/python{version}"):
        command = [name, "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]
        try:
            said = subprocess.check_output(command, user=_NOBODY, group=_NOBODY, extra_groups=[], text=True)
        except (OSError, subprocess.CalledProcessError):
            continue
        if said.strip() == version:
            return [name]
    return []


@pytest.mark.parametrize(
    ("rights", "enough"),
    [("000001ffffffffff", True), ("00000000a80425fb", True), ("00000000a80425f8", False), ("00000000a80425fe", False)],
)
def test_root_has_not_its_rights_everywhere(rights: str, enough: bool) -> None:
    assert has_rights_of_root(f"Name:\tpython\nCapPrm:\t0\nCapEff:\t{rights}\n") is enough


_COMPILES = """
import sys
from pathlib import Path
from raysteps.sandbox.detect import find_sandbox
from raysteps.sandbox.task import Input, Output, Task
ran = find_sandbox().run(Task(("c++", "-c", Input(Path(sys.argv[1])), "-o", Output("object")), tools=True))
print(ran.outcome.code, bool(ran.outputs.get("object")))
"""


@pytest.mark.parametrize("without", ["-dac_override,-dac_read_search", "-chown"])
def test_root_without_rights_over_others_gets_what_a_tool_makes(without: str, tmp_path: Path) -> None:
    if not can_lend_users():
        pytest.skip("only root has these rights to lose")
    sandbox_named("bubblewrap")
    source = tmp_path / "empty.cpp"
    source.touch()
    command = ["setpriv", "--bounding-set", without, sys.executable, "-P", "-c", _COMPILES, str(source)]
    environment = {**os.environ, "PYTHONPATH": str(here().root / "grader" / "src")}
    said = subprocess.run(command, env=environment, capture_output=True, text=True, check=True, cwd="/").stdout
    assert said.split() == ["0", "True"]


def test_the_same_as_an_ordinary_user() -> None:
    if not can_lend_users():
        pytest.skip("only root can become somebody else; others run all of these tests as an ordinary user anyway")
    sandbox_named("bubblewrap")
    python = _python_for_others()
    if not python or here().root.stat().st_mode & 0o005 != 0o005:
        pytest.skip("the user nobody can start no Python of this version, or not read the kit")
    folder = Path(tempfile.mkdtemp(prefix="nobody-"))
    try:
        folder.chmod(0o777)
        tests = Path(__file__).parent
        packages = [str(Path(pytest.__file__).parents[1]), str(here().root / "grader" / "src")]
        outcome = subprocess.run(
            [*python, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "--basetemp", str(folder / "t"),
             "-k", "not ordinary", str(tests / "test_sandbox.py"), str(tests / "test_sandbox_choice.py")],
            user=_NOBODY, group=_NOBODY, extra_groups=[], cwd=tests.parent, check=False, capture_output=True, text=True,
            env={"PATH": "/usr/bin:/bin", "PYTHONPATH": os.pathsep.join(packages), "PYTHONDONTWRITEBYTECODE": "1"},
        )  # fmt: skip
    finally:
        shutil.rmtree(folder)
    assert outcome.returncode == 0, outcome.stdout[-5000:] + outcome.stderr[-2000:]
    assert "passed" in outcome.stdout
