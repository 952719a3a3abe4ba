"""A grader that hangs itself, even in the middle of one instruction of Python's, is ended from outside."""

import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import pytest

from raysteps.cli import supervise
from raysteps.cli.grade import seconds_at_most
from raysteps.toolchain import limits
from raysteps.toolchain.limits import restart_clock

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nobody stands beside the grader")
_START = """
import os, re, signal, sys, tempfile
from pathlib import Path
from raysteps.cli.app import exit_code_of
from raysteps.cli.supervise import run_with_timeout

def work():
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # from here on, and not only in the middle of what hangs
    Path(tempfile.gettempdir(), "left").touch()
    Path(sys.argv[2]).write_text(str(os.getpid()))
    return {work}

try:
    code = run_with_timeout(work, float(sys.argv[1]))
except BaseException as error:
    code = exit_code_of(error)
raise SystemExit(code)
"""
_HANGS = 're.match("(a+)+b", "a" * 60)'  # holds the interpreter for years: no signal is heard
_MAX_SECONDS = 60


def _start(work: str, seconds: float, tmp_path: Path) -> "subprocess.Popen[str]":
    (tmp_path / "scratch").mkdir()
    return subprocess.Popen(
        [sys.executable, "-c", _START.replace("{work}", work), str(seconds), str(tmp_path / "pid")],
        env={**os.environ, "TMPDIR": str(tmp_path / "scratch")},
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        start_new_session=True,
    )


def _runs(pid: int) -> bool:
    return Path(f"/proc/{pid}").exists()


def _pid_of_work(tmp_path: Path) -> int:
    end = time.monotonic() + _MAX_SECONDS
    path = tmp_path / "pid"
    while not (path.is_file() and path.read_text()):
        assert time.monotonic() < end, "it does not begin"
        time.sleep(0.02)
    return int(path.read_text())


def test_the_exit_code_is_that_of_the_work(tmp_path: Path) -> None:
    process = _start("3", 100, tmp_path)
    _, said = process.communicate(timeout=_MAX_SECONDS)
    assert (process.returncode, said) == (3, "")
    assert not list((tmp_path / "scratch").iterdir())


def test_a_hanging_grader_is_given_up(tmp_path: Path) -> None:
    process = _start(_HANGS, 1, tmp_path)
    pid = _pid_of_work(tmp_path)
    _, said = process.communicate(timeout=_MAX_SECONDS)
    assert said == "raysteps: the grader gave up after 1 s; look at the submission by hand\n"
    assert process.returncode == 4
    assert not _runs(pid)
    assert not list((tmp_path / "scratch").iterdir())


def test_ctrl_c_ends_a_hanging_grader(tmp_path: Path) -> None:
    process = _start(_HANGS, 1000, tmp_path)
    pid = _pid_of_work(tmp_path)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does
    _, said = process.communicate(timeout=_MAX_SECONDS)
    assert (process.returncode, said) == (130, "raysteps: interrupted\n")
    assert not _runs(pid)
    assert not list((tmp_path / "scratch").iterdir())


def test_a_grader_does_not_outlive_who_stands_beside_it(tmp_path: Path) -> None:
    process = _start(_HANGS, 1000, tmp_path)
    pid = _pid_of_work(tmp_path)
    process.kill()
    process.communicate(timeout=_MAX_SECONDS)
    end = time.monotonic() + _MAX_SECONDS
    while _runs(pid) and Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z":
        assert time.monotonic() < end
        time.sleep(0.02)


def test_the_clock_starts_anew_when_the_grader_has_done_work_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    end, held = os.pipe()
    now, waited = 0.0, list[float]()
    happens = iter((restart_clock, partial(os.close, held)))

    def select(files: list[int], _: object, __: object, seconds: float) -> tuple[list[int]]:
        nonlocal now
        waited.append(seconds)
        now += 9.0
        next(happens)()
        return (files[:1],)

    monkeypatch.setattr(limits, "_listeners", [held])
    monkeypatch.setattr(supervise, "select", SimpleNamespace(select=select))
    monkeypatch.setattr(supervise, "time", SimpleNamespace(monotonic=lambda: now))
    assert supervise._is_over(end, 10.0)
    assert waited == [10.0, 10.0]
    os.close(end)


def test_the_limit_of_a_submission_says_when() -> None:
    assert seconds_at_most(["grade", "jo", "--limit", "seconds=3"]) == 3600
    assert seconds_at_most(["grade", "jo", "--only", "2", "--limit", "submission_seconds=600"]) == 1200
    assert seconds_at_most(["grade", "--limit"]) == 3600
    assert seconds_at_most(["grade", "--limit", "moons=3"]) == 3600
