"""Holds the programs that are started here on one processor, so that they do not wander while they are measured."""

import os
from collections.abc import Iterator
from contextlib import contextmanager


def can_pin() -> bool:
    """Whether this system lets a program choose its processor."""
    return hasattr(os, "sched_setaffinity")


@contextmanager
def pinned() -> Iterator[bool]:
    """Programs started inside inherit one processor, the last that this one may use. Tells whether that worked."""
    if not can_pin():
        yield False
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(allowed)})
    try:
        yield True
    finally:
        os.sched_setaffinity(0, allowed)
