"""What is known of the step that is watched, and what it comes to in one line."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from raysteps.common.text import count, tenths
from raysteps.course.manifest import Step
from raysteps.progress.hints import Hint
from raysteps.results.model import HiddenResult, ImageResult, StepResult, TestResult
from raysteps.watch.edits import edited_first

Phase = Literal["looking", "checking", "idle"]
Tone = Literal["good", "bad", "warn", "plain"]

_BUILDS = {"passed", "partial", "failed", "crashed", "timeout"}


@dataclass
class StepView:
    """`full` tells the result of a check from that of a look; a look is `complete` when its last picture is there."""

    step: Step
    phase: Phase = "looking"
    said: str = ""
    saved: str = ""  # the time of the save, for people
    seconds: float | None = None  # from the save to the complete look
    result: StepResult | None = None
    out: Path | None = None
    complete: bool = False
    full: bool = False
    looked: tuple[TestResult, ...] = ()  # what the look before a check said of the tests
    gone: bool = False
    problem: str = ""
    hints: list[Hint] = field(default_factory=list)
    edited: tuple[str, ...] = ()  # the functions that the last edit was about
    following: Step | None = None  # what comes next, once this step is done

    @property
    def status(self) -> str:
        return self.result.status if self.result else ""

    @property
    def can_be_checked(self) -> bool:
        """Whether a check can say more than the look did."""
        return self.complete and not self.problem and not self.gone and self.status in _BUILDS

    @property
    def is_done(self) -> bool:
        return self.full and self.complete and self.status == "passed"

    @property
    def failed_tests(self) -> list[TestResult]:
        """First those of the function that was edited last; none that wait for another function."""
        tests = self.result.tests if self.result else []
        return edited_first(
            [(test.name, test) for test in tests if not test.passed and not test.waits_for], self.edited
        )

    @property
    def missed(self) -> list[HiddenResult]:
        """The same of the hidden items."""
        hidden = self.result.hidden if self.result else []
        return edited_first(
            [(item.name, item) for item in hidden if not item.passed and not item.waits_for], self.edited
        )


Items = Sequence[TestResult | ImageResult | HiddenResult]


def passed_of(items: Items) -> tuple[int, int]:
    """How many passed, and of how many."""
    return sum(item.passed for item in items), len(items)


def _of(kind: str, items: Items) -> str:
    right, all_ = passed_of(items)
    return f"{count(all_, kind)} right" if right == all_ else f"{right} of {count(all_, kind)} right"


def tally(result: StepResult) -> str:
    """`9 of 11 tests right, 2 pictures right`."""
    kinds: tuple[tuple[str, Items], ...] = (
        ("test", result.tests),
        ("picture", result.images),
        ("hidden item", result.hidden),
    )
    return ", ".join(_of(kind, items) for kind, items in kinds if items)


def verdict(view: StepView) -> tuple[Tone, str]:
    """The one line that matters."""
    result = view.result
    if view.gone:
        return "warn", f"{view.step.file} is gone. Waiting for it to come back."
    if view.problem:
        return "bad", view.problem
    if result is None:
        return "plain", "Building"
    if view.status == "not-started":
        return "plain", f"Not started: {view.step.file} is still the stub."
    if view.status == "does-not-build":
        return "bad", "It does not build."
    if not view.complete:
        return "plain", tally(result) or "It builds"
    if view.is_done:
        return "good", f"Passed: {tenths(result.points)} of {tenths(result.max)} points."
    if view.full:
        tone: Tone = "warn" if result.points else "bad"
        return tone, f"{tenths(result.points)} of {tenths(result.max)} points: {tally(result)}."
    return ("good" if view.status == "passed" else "bad"), f"{tally(result)}."
