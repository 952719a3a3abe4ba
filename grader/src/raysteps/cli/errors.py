"""How a command ends: with what exit code, and with what words when something went wrong."""

import os
import sys

from rich.console import Console

from raysteps.common.errors import RaystepsError

_NO_TERMINAL = 10_000  # columns
EXITS = """exit codes: 0 all passed, 1 checks failed, 2 usage, 3 the student's code does not build, 4 grader fault,
130 interrupted"""


def console_here() -> Console:
    """As wide as the terminal; where there is none, lines are not broken."""
    return Console() if sys.stdout.isatty() else Console(width=_NO_TERMINAL)


def exit_code_of(error: BaseException) -> int:
    """Says what went wrong; SystemExit and the like are none of its business, and with RAYSTEPS_DEBUG no fault is."""
    if isinstance(error, RaystepsError):
        print(f"raysteps: {error}", file=sys.stderr)
        return error.exit_code
    if isinstance(error, KeyboardInterrupt):
        print("raysteps: interrupted", file=sys.stderr)
        return 130
    if not isinstance(error, Exception) or os.environ.get("RAYSTEPS_DEBUG"):
        raise error
    Console(stderr=True).print_exception(max_frames=4)
    print("raysteps: this is a fault of the grader, not of your code", file=sys.stderr)
    return 4
