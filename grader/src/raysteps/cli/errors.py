"""How a command ends: with what exit code, and with what words when something went wrong."""

import os
import sys

from rich.console import Console

from raysteps.common.errors import RaystepsError

_NO_TERMINAL = 10_000  # columns
_SIGPIPE = 128 + 13  # as a shell has it of programs that a closed pipe ends
EXITS = """exit codes: 0 all passed, 1 checks failed, 2 usage, 3 the student's code does not build, 4 grader fault,
130 interrupted"""


class _Console(Console):
    def on_broken_pipe(self) -> None:
        raise BrokenPipeError  # not an exit code of 1: see `exit_code_of`


def console_here() -> Console:
    """As wide as the terminal; where there is none, lines are not broken."""
    return _Console() if sys.stdout.isatty() else _Console(width=_NO_TERMINAL)


def _reader_is_gone(error: BaseException) -> bool:
    """Whether who reads what is printed has read enough, as `head` does. Then nothing more is printed."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        pass
    else:
        return isinstance(error, BrokenPipeError)
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return True


def exit_code_of(error: BaseException) -> int:
    """Says what went wrong; SystemExit and the like are none of its business, and with RAYSTEPS_DEBUG no fault is."""
    if _reader_is_gone(error):
        return _SIGPIPE
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
