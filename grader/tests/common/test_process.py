"""Programs that misbehave."""

import sys
import threading
import time
from pathlib import Path

import pytest

from raysteps.common.files import file_lock
from raysteps.common.process import Outcome, run


def _python(code: str, seconds: float = 20.0, cap: int = 1 << 20) -> Outcome:
    return run([sys.executable, "-c", code], seconds=seconds, cap=cap)


def test_output_and_code() -> None:
    outcome = _python("import sys; print('out'); print('err', file=sys.stderr); sys.exit(3)")
    assert (outcome.code, outcome.stdout, outcome.stderr) == (3, "out\n", "err\n")
    assert outcome.signal_name is None


def test_a_crash_has_a_name() -> None:
    assert _python("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)").signal_name == "SIGSEGV"


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("terminate called after throwing\n  what():  no table\x1b[2J\n", "an exception that nobody caught: no table"),
        ("1\na.cpp:3: int f(int): Assertion `n < 9' failed.\n", "an assertion that does not hold: n < 9"),
        ("optional:477: int get(): Assertion 'engaged()' failed.", "an assertion that does not hold: engaged()"),
        ("Assertion failed: (n < 9), function f, file a.cpp, line 3.", "an assertion that does not hold: n < 9"),
        (
            "libc++abi: terminating due to uncaught exception of type std::runtime_error: no table",
            "an exception that nobody caught: no table",
        ),
        ("  what():  no table\nlater\n", "an exception that nobody caught, or an assertion that does not hold"),
        ("Assertion '" * 90_000, "an exception that nobody caught, or an assertion that does not hold"),
    ],
)
def test_an_abort_is_told_in_the_programs_own_words(said: str, told: str) -> None:
    assert Outcome(-6, timed_out=False, stdout="", stderr=said, seconds=0).signal_words == f"SIGABRT: {told}"


def test_a_hang_is_stopped() -> None:
    start = time.monotonic()
    outcome = _python("import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); time.sleep(60)", seconds=1)
    assert outcome.timed_out
    assert time.monotonic() - start < 30


def test_closed_pipes_do_not_hide_a_hang() -> None:
    assert _python("import os, time; os.close(1); os.close(2); time.sleep(60)", seconds=1).timed_out


def test_a_flood_is_capped() -> None:
    assert len(_python("print('x' * 5_000_000)", cap=1000).stdout) == 1000


def test_a_child_that_holds_the_pipe_does_not_hold_the_grader() -> None:
    start = time.monotonic()
    code = (
        "import os, time\nif os.fork() == 0:\n    os.setsid()\n    time.sleep(60)\nelse:\n    print('done', flush=True)"
    )
    outcome = _python(code)
    assert outcome.stdout == "done\n"
    assert time.monotonic() - start < 30


def test_windows_tells_crashes_by_large_exit_codes() -> None:
    def name(code: int) -> str | None:
        return Outcome(code, timed_out=False, stdout="", stderr="", seconds=0).signal_name

    assert name(0xC0000005) == "SIGSEGV"
    assert name(0xC0000017) == "exception 0xc0000017"
    assert name(255) is None


def test_who_has_to_wait_for_a_lock_can_say_so(tmp_path: Path) -> None:
    waits, done = threading.Event(), threading.Event()

    def second() -> None:
        with file_lock(tmp_path / "lock", waits.set):
            done.set()

    with file_lock(tmp_path / "lock", lambda: pytest.fail("nobody holds it")):
        thread = threading.Thread(target=second)
        thread.start()
        assert waits.wait(60)
        assert not done.is_set()
    thread.join(60)
    assert done.is_set()
