"""How a command ends: with what exit code, and with what words when something went wrong."""

import argparse
import os
import sys
from collections.abc import Callable, Sequence

from rich.console import Console

from raysteps.common.errors import RaystepsError

_NO_TERMINAL = 10_000  # columns
EXITS = """exit codes: 0 all passed, 1 checks failed, 2 usage, 3 the student's code does not build, 4 grader fault,
130 interrupted"""


def console_here() -> Console:
    """As wide as the terminal; where there is none, lines are not broken."""
    return Console() if sys.stdout.isatty() else Console(width=_NO_TERMINAL)


def ended(
    run: Callable[[Sequence[str]], int], parser: Callable[[], argparse.ArgumentParser], words: Sequence[str]
) -> int:
    """Runs what the words of the command line ask for; without words it prints the help."""
    if not words:
        parser().print_help(sys.stderr)
        return 2
    try:
        return run(words)
    except RaystepsError as error:
        print(f"raysteps: {error}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        print("raysteps: interrupted", file=sys.stderr)
        return 130
    except Exception:
        if os.environ.get("RAYSTEPS_DEBUG"):
            raise
        Console(stderr=True).print_exception(max_frames=4)
        print("raysteps: this is a fault of the grader, not of your code", file=sys.stderr)
        return 4
