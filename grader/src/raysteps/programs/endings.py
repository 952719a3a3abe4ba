"""How a student's program ended, in words."""

from raysteps.common.text import in_seconds, printable, shorten
from raysteps.results.model import Ending
from raysteps.sandbox.task import Ran

ENDLESS = "Is there an endless loop? Once a program of a step has hung, the next ones get less time."


def ending_of(ran: Ran, what: str) -> tuple[Ending, str]:
    """`what` is what the program was to make, such as `The picture`. Only for a program that did not make it."""
    outcome = ran.outcome
    if ran.stopped == "memory":
        return "crashed", f"{what} needed more memory than a program may have here."
    if outcome.timed_out or ran.stopped in ("wall", "cpu"):
        return "timeout", f"{what} was not ready after {in_seconds(outcome.seconds)}. {ENDLESS}"
    if outcome.signal_name is not None:
        return "crashed", f"{what} was not made: the program crashed ({outcome.signal_words})."
    if outcome.code != 0:
        said = shorten(printable(outcome.stderr.strip().rpartition("\n")[2]), 200)
        return "crashed", f"{what} was not made: the program gave up with exit code {outcome.code}" + (
            f": {said}" if said else "."
        )
    return "wrong", ""
