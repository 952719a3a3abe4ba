"""What `raysteps` does first."""

import sys
from contextlib import suppress
from pathlib import Path

from raysteps.bootstrap.venv import UNDERSTOOD, CannotSetUp, Venv, say, set_for

_USAGE = 2


def _set_up(venv: Venv, wanted: str) -> None:
    from raysteps.bootstrap.requirements import install_optional, install_required  # rarely: they take long to load

    install_required()
    if venv.is_whole:  # a students' kit grades nobody and has no wide trees
        install_optional()
    venv.make(wanted)


def read() -> None:
    """Ends this process with what there is to say of its words: see `Venv.answer`."""
    from raysteps.bootstrap.requirements import AbsentPackages

    sys.meta_path.append(AbsentPackages())
    with suppress(Exception):  # then it is said when the packages are there
        from raysteps.cli.app import read_words

        read_words()
    sys.exit(UNDERSTOOD)


def _complete(venv: Venv, wanted: str, words: list[str]) -> None:
    """Brings what another command has not brought meanwhile."""
    if not venv.is_made():
        _set_up(venv, wanted)
    elif not venv.has(wanted):
        venv.add(wanted, " ".join(words[:2] if words[0] == "dev" else words[:1]))


def main(root: str, words: list[str]) -> int:
    """Sets up what is missing, once, and runs the command: in this process where it is the right one already."""
    venv, wanted = Venv(Path(root)), set_for(words)
    try:
        if not (venv.is_made() and venv.has(wanted)):
            code = venv.answer(words)
            if code is not None:
                return code
            with venv.alone():
                _complete(venv, wanted, words)
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
