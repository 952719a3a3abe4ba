"""What `raysteps` does first."""

import sys
from pathlib import Path

from raysteps.bootstrap.venv import CannotSetUp, Venv, say

_USAGE = 2


def _set_up(venv: Venv) -> None:
    from raysteps.bootstrap.requirements import get_what_is_needed, get_what_is_useful  # rarely: they take long to load

    get_what_is_needed()
    if (venv.root / "solutions").is_dir():  # a students' kit grades nobody and has no wide trees
        get_what_is_useful()
    venv.make()


def main(root: str, words: list[str]) -> int:
    """Sets up what is missing, once, and runs the command: in this process where it is the right one already."""
    venv = Venv(Path(root))
    try:
        if not venv.is_ready():
            _set_up(venv)
        elif venv.is_this():
            sys.argv[1:] = words
            from raysteps.cli.app import run_process

            return run_process(words)
        return venv.run(words)
    except CannotSetUp as problem:
        say(str(problem))
        return _USAGE
    except KeyboardInterrupt:
        say("interrupted")
        return 130
