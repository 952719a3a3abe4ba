"""Finds the strongest sandbox that works here."""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path

from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.project import here
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Limits, Sandbox, Task

if sys.platform != "win32":
    from raysteps.sandbox.bubblewrap import Bubblewrap
    from raysteps.sandbox.namespaces import AsRoot
    from raysteps.sandbox.supervised import Lockdown
    from raysteps.sandbox.task_dir import sweep
    from raysteps.sandbox.users import can_lend_users

VARIABLE = "RAYSTEPS_SANDBOX"
_TRIED_SECONDS = 120.0  # a machine that stands still for a while has no weaker sandbox for it
_CHOICES = ("bubblewrap", "fallback", "none")
_ON_WINDOWS = "\nOn Windows, use WSL: docs/where-students-work.md." if sys.platform == "win32" else ""


def _works(sandbox: Sandbox) -> str:
    """Tries it once; the reason why not, or nothing."""
    program = shutil.which("true")
    if program is None:
        return "the program true, to try it with, was not found"
    try:
        ran = sandbox.run(Task((Input(Path(program), "true"),), Limits(wall_seconds=_TRIED_SECONDS)))
    except (GraderFault, OSError, ValueError) as error:
        return str(error)
    return "" if ran.outcome.code == 0 else f"the program true ended with {ran.outcome.code}: {ran.outcome.stderr}"


def _try(make: Callable[[], Sandbox]) -> tuple[Sandbox | None, str]:
    try:
        sandbox = make()
    except (GraderFault, OSError, subprocess.TimeoutExpired) as error:
        return None, str(error)
    reason = _works(sandbox)
    return (None, reason) if reason else (sandbox, "")


@cache
def _sweep_once() -> None:
    if sys.platform != "win32":
        sweep()


@cache
def _bubblewrap() -> tuple[Sandbox | None, str]:
    if sys.platform != "linux":
        return None, "there are no namespaces on this system"
    secrets = (here().root,)
    sandbox, reason = _try(lambda: Bubblewrap(secrets))
    if sandbox is None and can_lend_users():
        sandbox, _ = _try(lambda: Bubblewrap(secrets, AsRoot()))
    return sandbox, reason


@cache
def _fallback() -> tuple[Sandbox | None, str]:
    if sys.platform != "linux":
        return None, "it is for Linux only"
    return _try(lambda: Lockdown((here().root,)))


def _asked_for() -> str:
    choice = os.environ.get(VARIABLE, "")
    if choice and choice not in _CHOICES:
        raise UsageError(f"{VARIABLE} is {choice!r}; it may be {', '.join(_CHOICES)}, or be absent.")
    return choice


def _refuse_noexec() -> None:
    """What a student's compiler makes could not be run there, and no step would be to blame for that."""
    folder = tempfile.gettempdir()
    if sys.platform != "win32" and os.statvfs(folder).f_flag & getattr(os, "ST_NOEXEC", 0):
        raise UsageError(
            f"{folder}: is mounted so that no program there can be run (noexec). Expected a folder for temporary files "
            "where programs run: set TMPDIR to one, or in a container mount it as in `--tmpfs /scratch:exec`"
        )


def find_sandbox(*, require: bool = False) -> Sandbox:
    """The strongest there is; with `require`, an error if it is not strong."""
    choice = _asked_for()
    _refuse_noexec()
    _sweep_once()
    by_name = {"bubblewrap": [_bubblewrap], "fallback": [_fallback], "none": []}
    candidates = by_name.get(choice, [_bubblewrap, _fallback])
    reasons = []
    sandbox: Sandbox | None = None
    for candidate in candidates:
        sandbox, reason = candidate()
        if sandbox is not None:
            break
        reasons.append(reason)
    if sandbox is None and choice in ("bubblewrap", "fallback"):
        raise UsageError(f"{VARIABLE} asks for {choice}, but it does not work here: {reasons[0]}")
    found = sandbox or LimitsOnly()
    if require and not found.isolation.strong:
        why = reasons[0] if reasons else f"{VARIABLE} asks for {choice}."
        raise UsageError(
            f"A strong sandbox is required, and there is none here: {why}{_ON_WINDOWS}\nSee docs/sandbox.md."
        )
    return found
