"""How long a student's program may run for the examples that a step is shown with."""

import math
import time

_RUN_SECONDS = 2.0


class Patience:
    """Seconds that a student's program may run for the examples of a step. Time in which it waits for a processor does
    not count, so that a busy machine shows the same examples; but a program that sleeps, and a judge that is slow, come
    to an end too: after `longest` seconds on the clock, from the first run on."""

    def __init__(self, seconds: float, longest: float = 20.0) -> None:
        self._left = seconds
        self._longest = longest
        self._end = math.inf

    def next_run(self) -> float:
        now = time.monotonic()
        self._end = min(self._end, now + self._longest)
        return _RUN_SECONDS if self._left > 0 and now < self._end else 0.0

    def spend(self, seconds: float) -> None:
        self._left -= seconds
