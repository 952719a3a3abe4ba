"""How long the functions of a step may run."""

_STEP_FACTOR = 4  # all functions of a step together may take this many times the limit of one run
_AFTER_A_HANG = 0.25  # of the limit
_LEAST = 1.0  # seconds that say something, on any machine


class TimeBudget:
    """Each function is asked once at least, whatever those before it took: a function that hangs silences nobody.
    Who hung once may hang in all that follows, and gets less time from then on."""

    def __init__(self, seconds: float, functions: int) -> None:
        self._limit = seconds
        self._short = min(seconds, max(_LEAST, _AFTER_A_HANG * seconds))
        self._left = _STEP_FACTOR * seconds
        self._to_come = functions
        self._hung = False

    def next_function(self) -> float:
        """Seconds of its first run."""
        self._to_come -= 1
        return max(self._short, self.next_run())

    def next_run(self) -> float:
        """Seconds of one more run of the same function; 0 when there is no time left for it."""
        free = self._left - self._to_come * self._short
        most = min(free, self._short if self._hung else self._limit)
        return most if most >= self._short else 0.0

    def spend(self, seconds: float, *, hung: bool) -> None:
        self._left -= seconds
        self._hung = self._hung or hung
