"""The trusted program beside a box: how it ends, and how little it finds, should a box ever lead it astray."""

import os
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from sandboxes import any_sandbox, hostile, sandbox, sandbox_named, secret
from watch_fakes import is_running, wait_for

from raysteps.common.errors import GraderFault
from raysteps.course.project import here
from raysteps.sandbox import beside, supervised
from raysteps.sandbox.keepers import start_keeper
from raysteps.sandbox.lockdown import landlock_version, syscall_filter
from raysteps.sandbox.task import Input, Limits, Output, Sandbox, StartedProcess, Task, TaskResult, TrustedCommand, Word
from raysteps.sandbox.users import can_lend_users

__all__ = ["any_sandbox", "hostile", "sandbox", "secret"]  # pytest finds fixtures by name

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="boxes are for Linux")

# A box that waits until nobody asks it any more.
_BOX = ("/usr/bin/env", "cat")
_LIMITS = Limits(wall_seconds=30.0, cpu_seconds=30.0)


def _ask(sandbox: Sandbox, program: Path, *words: Word, stdin: bytes = b"") -> TaskResult:
    """Runs the program that misbehaves in the place of the trusted one."""
    return sandbox.run(Task(_BOX, _LIMITS, tools=True, beside=TrustedCommand((Input(program), *words), stdin)))


def _said(sandbox: Sandbox, program: Path, *words: Word) -> list[str]:
    ran = _ask(sandbox, program, *words)
    assert ran.outcome.code == 0, ran.outcome.stderr
    return ran.outcome.stdout.splitlines()


def test_its_words_and_its_files_are_those_of_the_task(any_sandbox: Sandbox, hostile: Path, secret: Path) -> None:
    echo = _ask(any_sandbox, hostile, "echo", stdin=b"done\n" * 100_000)
    assert (echo.outcome.code, echo.outcome.stdout, echo.outputs) == (0, "done\n" * 100_000, {})
    written = _ask(any_sandbox, hostile, "write", Output("number"), "2")
    assert (written.outcome.code, written.outputs) == (0, {"number": b"x" * (2 << 20)})
    assert _said(any_sandbox, hostile, "read", Input(secret, "0.nff")) == ["the answer is 42"]


@pytest.mark.parametrize(("way", "name"), [("crash", "SIGSEGV"), ("abort", None)])
def test_a_signal_that_ends_it_is_a_crash_of_the_step(
    any_sandbox: Sandbox, hostile: Path, way: str, name: str | None
) -> None:
    """It works on what the box answers; whatever comes of that costs no other step."""
    ran = _ask(any_sandbox, hostile, way)
    assert ran.outcome.signal_name == name if name else ran.outcome.signal_name is not None
    assert not ran.outcome.timed_out
    assert "asks the step's functions was ended by SIG" in ran.outcome.stderr


def test_what_it_tells_of_the_wire_ends_the_step(any_sandbox: Sandbox, hostile: Path) -> None:
    ran = _ask(any_sandbox, hostile, "code", "71")
    assert ran.outcome.code == 1
    assert "something else than the step's functions" in ran.outcome.stderr


@pytest.mark.parametrize(
    ("code", "said"),
    [
        (72, "the functions called each other without an end"),
        (73, "the answers of the step's functions were longer than 128 MB at once"),
    ],
)
def test_an_end_of_the_wire_is_told_of_whoever_sees_it(
    any_sandbox: Sandbox, hostile: Path, code: int, said: str
) -> None:
    box = ("/usr/bin/env", "sh", "-c", f"exit {code}")
    ran = any_sandbox.run(Task(box, _LIMITS, tools=True, beside=TrustedCommand((Input(hostile), "code", "70"))))
    assert (ran.outcome.code, ran.outcome.stderr) == (1, said)
    assert _ask(any_sandbox, hostile, "code", str(code)).outcome.stderr == said


def test_an_ending_that_it_does_not_have_is_the_kits_fault(any_sandbox: Sandbox, hostile: Path) -> None:
    with pytest.raises(GraderFault, match="ended with 99"):
        _ask(any_sandbox, hostile, "code", "99")


def test_a_program_that_is_none_is_the_kits_fault(any_sandbox: Sandbox, secret: Path) -> None:
    with pytest.raises(GraderFault, match="beside the box"):
        _ask(any_sandbox, secret)


def test_a_keeper_that_cannot_begin_is_no_crash_of_the_step(hostile: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def start(*words: Any, stderr: int | None = None, **files: Any) -> StartedProcess:
        of_the_trusted = stderr is not None  # whose words go to a file
        return subprocess.Popen(["false"]) if of_the_trusted else start_keeper(*words, **files)

    monkeypatch.setattr(supervised, "start_keeper", start)
    with pytest.raises(GraderFault, match="cannot be started"):
        _ask(sandbox_named("fallback"), hostile, "echo")


def test_it_uses_time_that_is_counted(any_sandbox: Sandbox, hostile: Path) -> None:
    assert _ask(any_sandbox, hostile, "spin", "1", "0.5").cpu_seconds >= 0.5


def test_its_time_on_the_clock_is_bounded(any_sandbox: Sandbox, hostile: Path) -> None:
    limits = Limits(wall_seconds=1.0, cpu_seconds=1.0)
    ran = any_sandbox.run(Task(_BOX, limits, tools=True, beside=TrustedCommand((Input(hostile), "stubborn"))))
    assert ran.hung


def test_its_memory_is_bounded(any_sandbox: Sandbox, hostile: Path) -> None:
    """From its first moment on, with a fence around it or not: it holds what a box sends."""
    soft, hard = map(int, _said(any_sandbox, hostile, "limit")[0].split())
    assert 0 < soft <= hard <= 4096 << 20


def test_it_has_its_words_and_the_wire_open(sandbox: Sandbox, hostile: Path) -> None:
    (numbers,) = _said(sandbox, hostile, "files")
    stdin, stdout, stderr, *wire = map(int, numbers.split())
    assert (stdin, stdout, stderr, len(wire)) == (0, 1, 2, 2)


def test_its_environment_is_the_wire(any_sandbox: Sandbox, hostile: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TOKEN", "secret")
    names = {line.partition("=")[0] for line in _said(any_sandbox, hostile, "environment")}
    assert "RAYSTEPS_BOX" in names
    assert names <= {"RAYSTEPS_BOX", "LC_ALL", "HOME", "PWD"}


def test_it_opens_nothing_but_its_inputs(sandbox: Sandbox, hostile: Path, secret: Path, tmp_path: Path) -> None:
    if sandbox.isolation.name in ("other user", "landlock") and not landlock_version():
        pytest.skip("there is no Landlock in this kernel")
    solution = here().root / "solutions"
    places = [secret, secret.parent, here().root, solution, tmp_path, Path.home(), Path("/etc/passwd"), Path("/home")]
    asked = [*(str(place) for place in places), "/", "/tmp", f"/proc/{os.getpid()}/environ"]
    found = _said(sandbox, hostile, "open", *asked)
    assert not {*found} - {"/", "/tmp"}
    if sandbox.isolation.name != "bubblewrap":
        assert not found
    assert _ask(sandbox, hostile, "write", str(tmp_path / "mine"), "1").outcome.code == 1
    assert not (tmp_path / "mine").exists()


def test_the_system_refuses_it_what_it_refuses_a_box(sandbox: Sandbox, hostile: Path) -> None:
    if syscall_filter() is None:
        pytest.skip("there is no filter for this machine")
    assert not _said(sandbox, hostile, "ask")


def test_it_reaches_nobody_over_the_network(sandbox: Sandbox, hostile: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        assert _ask(sandbox, hostile, "connect", str(server.getsockname()[1])).outcome.code == 1


@pytest.mark.parametrize("name", ["bubblewrap", "bubblewrap as root"])
def test_it_sees_no_other_process(hostile: Path, name: str) -> None:
    with subprocess.Popen(["sleep", "600"]) as another:
        try:
            assert _ask(sandbox_named(name), hostile, "kill", str(another.pid)).outcome.code == 1
            assert another.poll() is None
        finally:
            another.kill()


def test_as_root_it_is_a_user_of_its_own(sandbox: Sandbox, hostile: Path) -> None:
    if not can_lend_users():
        pytest.skip("only root can try this")
    assert _said(sandbox, hostile, "user") != ["0"]


def test_a_fence_that_ends_early_leaves_nobody() -> None:
    """As a bubblewrap leaves its first process, which waits for it."""
    with subprocess.Popen(
        ["sh", "-c", "sleep 1000 >&2 & echo $!"], stdout=subprocess.PIPE, start_new_session=True
    ) as fence:
        assert fence.stdout is not None
        child = int(fence.stdout.readline())
        assert is_running(child)
        beside._wait(fence, 60)
    wait_for(lambda: not is_running(child))
