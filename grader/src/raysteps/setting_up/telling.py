"""Speaks to the person at the keyboard before anything else can."""

import sys


def say(text: str) -> None:
    print(f"raysteps: {text}", file=sys.stderr, flush=True)


class CannotSetUp(Exception):
    """What is missing, and what to type."""
