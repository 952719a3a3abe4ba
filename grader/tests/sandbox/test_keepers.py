"""Keepers are forked by a server: what becomes of it, and of them."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from sandboxes import PROGRAM, Misbehave, hostile, misbehave, processes_running
from watch_fakes import is_running, wait_for

from raysteps.sandbox import keepers
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.monitor import descendants
from raysteps.sandbox.task import Input, Output, Task

__all__ = ["hostile", "misbehave"]  # pytest finds fixtures by name

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere each keeper is a program of its own")
_LONG = 60.0  # to wait for something that comes at once where nothing is wrong


@pytest.fixture(autouse=True)
def servers(monkeypatch: pytest.MonkeyPatch) -> Iterator[keepers._Servers]:
    """Of this test alone, where none failed yet."""
    own = keepers._Servers()
    monkeypatch.setattr(keepers, "_servers", own)
    yield own
    own.end()


def _pid(servers: keepers._Servers) -> int:
    assert servers._server is not None
    return servers._server.process.pid


def _open_files(pid: int) -> int:
    return len(list(Path(f"/proc/{pid}/fd").iterdir()))


def test_all_tasks_have_one_server_and_leave_nothing_there(misbehave: Misbehave, servers: keepers._Servers) -> None:
    misbehave(LimitsOnly(), "code", "0")
    server = _pid(servers)
    wait_for(lambda: descendants(server) == {server})
    files = _open_files(server)
    for code in range(5):
        assert misbehave(LimitsOnly(), "code", str(code)).outcome.code == code
    assert _pid(servers) == server
    wait_for(lambda: descendants(server) == {server})
    assert _open_files(server) == files


def _is_right(program: Path, number: int) -> bool:
    """Whether two tasks with this number get their own files."""
    data = f"{number}\n".encode() * 1000
    megabytes = 1 + number % 3
    echoed = LimitsOnly().run(Task((Input(program), "echo"), stdin=data))
    made = LimitsOnly().run(Task((Input(program), "write", Output(f"{number}.ppm"), str(megabytes))))
    return echoed.outcome.stdout.encode() == data and made.outputs == {f"{number}.ppm": b"x" * (megabytes << 20)}


def test_tasks_at_the_same_time_get_their_own_files(hostile: Path, servers: keepers._Servers) -> None:
    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(lambda number: _is_right(hostile, number), range(40)))


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGSTOP])
def test_a_server_that_fails_costs_no_task(
    misbehave: Misbehave, servers: keepers._Servers, number: signal.Signals, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(keepers, "_PATIENCE", 1.0)
    for code in range(5):
        if servers._server is not None:
            os.kill(_pid(servers), number)
        assert misbehave(LimitsOnly(), "code", str(code)).outcome.code == code


def test_a_server_that_dies_while_many_wait_costs_no_task(hostile: Path, servers: keepers._Servers) -> None:
    with ThreadPoolExecutor(8) as pool:
        found = [pool.submit(_is_right, hostile, number) for number in range(40)]
        killed: set[keepers._ForkServer] = set()
        while len(killed) < 2 and not all(one.done() for one in found):
            server = servers._server
            if server is not None and server not in killed:
                os.kill(server.process.pid, signal.SIGKILL)
                killed.add(server)
        assert all(one.result() for one in found)
    assert killed


def test_without_any_server_a_task_runs_all_the_same(misbehave: Misbehave, servers: keepers._Servers) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(keepers, "_KEEPER", [sys.executable, "-c", ""])
        for _ in range(keepers._MAX_FAILURES):
            assert servers.fork({}, ["/bin/true"], {}) is None
    assert misbehave(LimitsOnly(), "code", "4").outcome.code == 4
    assert servers._server is None


def test_a_long_command_arrives(hostile: Path, servers: keepers._Servers) -> None:
    words = ["x" * 100_000] * 10
    ran = LimitsOnly().run(Task((Input(hostile), "code", "3", *words)))
    assert ran.outcome.code == 3


def test_a_process_that_was_forked_has_a_server_of_its_own(misbehave: Misbehave, servers: keepers._Servers) -> None:
    misbehave(LimitsOnly(), "code", "0")
    before = _pid(servers)
    child = os.fork()
    if child == 0:
        code = 1
        try:
            servers.start_anew()  # this test's are not those that a fork tells
            code = misbehave(LimitsOnly(), "code", "5").outcome.code
            servers.end()
        finally:
            os._exit(code)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 5
    assert misbehave(LimitsOnly(), "code", "6").outcome.code == 6
    assert _pid(servers) == before


def test_a_fork_is_told_to_the_servers() -> None:
    program = (
        "import os; from raysteps.sandbox import keepers as k; k._servers._server = k._ForkServer(); p = os.fork()\n"
        "if p == 0: os._exit(0 if k._servers._server is None else 1)\n"
        "raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(p, 0)[1]))"
    )
    there = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    assert subprocess.run([sys.executable, "-c", program], env=there, check=False, timeout=_LONG).returncode == 0


_GRADER = """
import sys
from pathlib import Path
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Limits, Task
LimitsOnly().run(Task((Input(Path(sys.argv[1]), sys.argv[2]), "stubborn"), limits=Limits(wall_seconds=600)))
"""


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_everything_ends_with_the_grader(hostile: Path, number: signal.Signals) -> None:
    """A terminal tells the whole group of an interrupt."""
    name = f"{PROGRAM}-{number.name}"
    with subprocess.Popen(
        [sys.executable, "-c", _GRADER, str(hostile), name],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # where the tests run in the background
    ) as grader:
        try:
            wait_for(lambda: bool(processes_running(name)))
            started = descendants(grader.pid) - {grader.pid}
            assert len(started) >= 3  # the server, a keeper, and what it keeps
            if number == signal.SIGINT:
                os.killpg(grader.pid, number)
            else:
                grader.send_signal(number)
            grader.wait(_LONG)
        finally:
            grader.kill()
    wait_for(lambda: not any(map(is_running, started)))
    wait_for(lambda: not processes_running(name))
