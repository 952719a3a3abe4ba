"""The trusted program beside a box: how it ends, and what it may do where bubblewrap is around it."""

import os
import sys
from pathlib import Path

import pytest
from sandboxes import any_sandbox, sandbox_named

from raysteps.common.errors import GraderFault
from raysteps.sandbox.task import Beside, Limits, Output, Sandbox, Task, TaskResult

__all__ = ["any_sandbox"]  # pytest finds fixtures by name

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="boxes are for Linux")

# A box that waits until nobody asks it any more.
_BOX = ("/usr/bin/env", "cat")
_LIMITS = Limits(wall_seconds=30.0, cpu_seconds=30.0)


def _ask(sandbox: Sandbox, program: str, *more: Output) -> TaskResult:
    """Runs Python code in the place of the trusted program."""
    return sandbox.run(Task(_BOX, _LIMITS, tools=True, beside=Beside((sys.executable, "-c", program, *more))))


def test_its_words_and_its_files_are_those_of_the_task(any_sandbox: Sandbox) -> None:
    write = "import sys; open(sys.argv[1], 'w').write('seven'); print('done')"
    ran = _ask(any_sandbox, write, Output("number"))
    assert (ran.outcome.code, ran.outcome.stdout.strip()) == (0, "done")
    assert ran.outputs == {"number": b"seven"}


@pytest.mark.parametrize("name", ["SIGSEGV", "SIGABRT"])
def test_a_signal_that_ends_it_is_a_crash_of_the_step(any_sandbox: Sandbox, name: str) -> None:
    """It works on what the box answers; whatever comes of that costs no other step."""
    ran = _ask(any_sandbox, f"import os, resource, signal; os.kill(os.getpid(), signal.{name}); os.abort()")
    assert ran.outcome.signal_name is not None
    assert not ran.outcome.timed_out
    assert "asks the step's functions was ended by SIG" in ran.outcome.stderr


def test_what_it_tells_of_the_wire_ends_the_step(any_sandbox: Sandbox) -> None:
    ran = _ask(any_sandbox, "raise SystemExit(71)")
    assert ran.outcome.code == 1
    assert "something else than the step's functions" in ran.outcome.stderr


def test_an_ending_that_it_does_not_have_is_the_kits_fault(any_sandbox: Sandbox) -> None:
    with pytest.raises(GraderFault, match="ended with 99"):
        _ask(any_sandbox, "raise SystemExit(99)")


def test_it_uses_time_that_is_counted(any_sandbox: Sandbox) -> None:
    ran = _ask(any_sandbox, "import time\nwhile time.process_time() < 0.5: pass")
    assert ran.cpu_seconds >= 0.5


def test_its_memory_is_bounded(any_sandbox: Sandbox) -> None:
    """From its first moment on, with a fence around it or not: it holds what a box sends."""
    ran = _ask(any_sandbox, "import resource; print(*resource.getrlimit(resource.RLIMIT_AS))")
    soft, hard = map(int, ran.outcome.stdout.split())
    assert 0 < soft <= hard <= 4096 << 20


@pytest.mark.parametrize("name", ["bubblewrap", "bubblewrap as root"])
def test_bubblewrap_fences_it_in(tmp_path: Path, name: str) -> None:
    """Should a box ever lead it astray: no network, no other process, no file but its own."""
    place = tmp_path / "mine"
    program = f"""
import os, socket
def can(work):
    try:
        work()
        return "yes"
    except OSError:
        return "no"
print(can(lambda: open({str(place)!r}, "w")), can(lambda: os.kill({os.getpid()}, 0)),
      can(lambda: socket.create_connection(("127.0.0.1", 9), 1)), len(socket.if_nameindex()))
"""
    ran = _ask(sandbox_named(name), program)
    assert ran.outcome.stdout.split() == ["no", "no", "no", "1"]
    assert not place.exists()
