"""Programs that are typed, some of them with keys that are pressed while they run."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from terminals import Terminal

from raysteps.common.process import run

_SECONDS = 600


@dataclass(frozen=True)
class Keys:
    """What is pressed once the program has printed certain words, and what it prints then."""

    after: str
    pressed: str
    then: str


@dataclass(frozen=True)
class Ending:
    """How a program comes to its end when all goes well. With keys it runs on a terminal."""

    keys: Keys | None = None
    codes: tuple[int, ...] = (0,)


def _on_a_terminal(command: Sequence[str], here: Path, keys: Keys, seconds: float) -> tuple[int, str]:
    terminal = Terminal(command, cwd=here, timeout=seconds)
    try:
        terminal.wait(keys.after)
        terminal.press(keys.pressed)
        terminal.wait(keys.then)
        return terminal.end(), terminal.printed
    finally:
        terminal.close()


def typed_at(command: Sequence[str], here: Path, ending: Ending, seconds: float = _SECONDS) -> str:
    """What a program printed that went well."""
    if ending.keys:
        code, printed = _on_a_terminal(command, here, ending.keys, seconds)
    else:
        outcome = run(command, seconds=seconds, cwd=here)
        code, printed = outcome.code, outcome.stdout + outcome.stderr
        assert not outcome.timed_out, f"stopped after {seconds} s\n{printed}"
    assert code in ending.codes, f"exit code {code}\n{printed}"
    return printed
