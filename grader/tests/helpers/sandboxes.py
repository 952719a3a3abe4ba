"""What the tests of the sandbox share: the sandboxes that there are here, and a program that misbehaves."""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest

from raysteps.common.errors import UsageError
from raysteps.course.project import here
from raysteps.sandbox.bubblewrap import Bubblewrap
from raysteps.sandbox.detect import VARIABLE, find_sandbox
from raysteps.sandbox.lockdown import landlock_version
from raysteps.sandbox.namespaces import AsRoot
from raysteps.sandbox.task import Input, Limits, Output, Sandbox, Task, TaskResult
from raysteps.sandbox.users import can_lend_users

Misbehave = Callable[..., TaskResult]
PROGRAM = f"program-{os.getpid()}"  # no other run of tests on this machine starts processes of that name


def sandbox_named(name: str) -> Sandbox:
    """Skips the test where there is no such sandbox."""
    if name.startswith("bubblewrap") and shutil.which("bwrap") is None:
        pytest.skip("bubblewrap is not installed")
    if name == "bubblewrap as root":
        return _as_root()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, name)
        try:
            return find_sandbox()
        except UsageError as error:
            if name == "bubblewrap" or (name == "fallback" and (can_lend_users() or landlock_version())):
                raise
            pytest.skip(str(error))


@cache
def _as_root() -> Sandbox:
    """What root gets where user namespaces are refused."""
    if not can_lend_users():
        pytest.skip("only root can try this")
    return Bubblewrap((here().root,), AsRoot())


@pytest.fixture(params=["bubblewrap", "bubblewrap as root", "fallback"])
def sandbox(request: pytest.FixtureRequest) -> Sandbox:
    return sandbox_named(str(request.param))


@pytest.fixture(params=["bubblewrap", "bubblewrap as root", "fallback", "none"])
def any_sandbox(request: pytest.FixtureRequest) -> Sandbox:
    return sandbox_named(str(request.param))


@pytest.fixture(scope="session")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The program of hostile.cpp."""
    program = tmp_path_factory.mktemp("hostile") / "hostile"
    source = Path(__file__).with_name("hostile.cpp")
    subprocess.run(["c++", "-std=c++20", "-pthread", str(source), "-o", str(program)], check=True)
    return program


@pytest.fixture
def misbehave(hostile: Path) -> Misbehave:
    """Runs the program in a sandbox, in one of its ways."""

    def run(sandbox: Sandbox, *words: str | Input | Output, **limits: float) -> TaskResult:
        chosen = Limits(**{"wall_seconds": 60, "memory_mb": 512, **limits})  # type: ignore[arg-type]
        return sandbox.run(Task((Input(hostile, PROGRAM), *words), limits=chosen))

    return run


@pytest.fixture
def secret() -> Iterator[Path]:
    """A file that every user of the machine may read."""
    with tempfile.TemporaryDirectory(prefix="secret-") as folder:
        Path(folder).chmod(0o755)
        path = Path(folder, "secret.txt")
        path.write_text("the answer is 42\n", encoding="ascii")
        path.chmod(0o644)
        yield path


def processes_running(program: str) -> list[str]:
    """The processes on the machine that were started under that name."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words[0].decode(errors="replace").endswith(f"/{program}") and os.getpid() != int(entry.name):
                found.append(entry.name)
    return found


def control_groups() -> set[str]:
    """The groups of this process's runs. Others on the machine come and go while it looks; those are passed over."""
    own = f"raysteps-{os.getpid()}-"
    return {f"{root}/{name}" for root, names, _ in os.walk("/sys/fs/cgroup") for name in names if own in name}
