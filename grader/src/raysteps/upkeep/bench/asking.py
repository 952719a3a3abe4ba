"""Asks raysteps-bench, which answers with JSON."""

import json
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.process import Outcome, run
from raysteps.upkeep.bench.pinning import pinned

_SECONDS = 4 * 3600
_MOST_TEXT = 1 << 30


def _checked(outcome: Outcome) -> str:
    if outcome.timed_out:
        raise GraderFault(f"raysteps-bench took more than {_SECONDS} seconds")
    if outcome.code == 2:
        raise UsageError(outcome.stderr.split("\nUsage:")[0].strip().removeprefix("raysteps-bench: "))
    if outcome.code != 0:
        raise GraderFault(outcome.stderr.strip() or f"raysteps-bench ended with {outcome.signal_name or outcome.code}")
    return outcome.stdout


def ask(program: Path, *words: str | Path) -> Any:
    """With all processors."""
    return json.loads(_checked(run([program, *words], seconds=_SECONDS)))


def ask_pinned(program: Path, *words: str | Path) -> Any:
    """On one processor, where the system allows that."""
    with pinned():
        return ask(program, *words)


def flat_nff(program: Path, scene: Path) -> str:
    """The scene as the kit reads it: nothing but spheres, cones and triangles."""
    return _checked(run([program, "nff", scene], seconds=_SECONDS, cap=_MOST_TEXT))
