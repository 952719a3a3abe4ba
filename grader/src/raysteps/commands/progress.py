"""Tells what is being done."""

import sys

from rich.console import Console
from rich.status import Status

from raysteps.kit.built_kit import Say


def progress(console: Console, status: Status) -> Say:
    """Beside the spinner on a terminal, elsewhere as lines on stderr."""

    def say(text: str) -> None:
        if console.is_terminal:
            status.update(text)
        else:
            print(f"raysteps: {text}", file=sys.stderr, flush=True)

    return say
