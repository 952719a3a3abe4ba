"""What is known of the step that is watched, which functions an edit was about, and what it comes to in one line."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, TypeVar

from raysteps.common.text import count, tenths
from raysteps.course.manifest import Step
from raysteps.course.stubs import tokens
from raysteps.progress.hints import Hint
from raysteps.results.model import HiddenResult, ImageResult, StepResult, TestResult

# Which functions of a step an edit was about.

_CLOSING = {"(": ")", "{": "}"}
_QUALIFIERS = {"const", "noexcept"}


def _closed(code: Sequence[str], start: int) -> int:
    """Behind the bracket that closes the one at `start`, or where the code ends."""
    opening, closing, depth = code[start], _CLOSING[code[start]], 0
    for at in range(start, len(code)):
        depth += (code[at] == opening) - (code[at] == closing)
        if depth == 0:
            return at + 1
    return len(code)


def _definitions(code: Sequence[str], name: str) -> Iterator[Sequence[str]]:
    """Parameters and bodies of all functions of that name, such as `Sphere::intersect`."""
    words = tokens(name)
    for at in range(len(code) - len(words)):
        if code[at : at + len(words)] == words and code[at + len(words)] == "(":
            end = _closed(code, at + len(words))
            while end < len(code) and code[end] in _QUALIFIERS:
                end += 1
            if end < len(code) and code[end] == "{":
                yield code[at : _closed(code, end)]


def edited_functions(before: str, after: str, step: Step) -> tuple[str, ...]:
    """The step's functions of which the code is no longer what it was."""
    old, new = tokens(before), tokens(after)
    return tuple(name for name in step.functions if [*_definitions(old, name)] != [*_definitions(new, name)])


Item = TypeVar("Item")


def _is_about(title: str, function: str) -> bool:
    """A function is named in full; a test begins with the function, or with its class."""
    names = (function, function.partition("::")[0])
    return any(title == name or title.startswith((f"{name}:", f"{name} ")) for name in names)


def edited_first(items: Iterable[tuple[str, Item]], functions: Sequence[str]) -> list[Item]:
    """The items with their titles: those about these functions before all others."""
    ordered = sorted(items, key=lambda pair: not any(_is_about(pair[0], name) for name in functions))
    return [item for _, item in ordered]


# The step that is watched.

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
    def hung(self) -> bool:
        """Whether something was stopped: a check would wait for the same once more."""
        items: Items = [*self.result.tests, *self.result.images] if self.result else []
        return any(item.outcome == "timeout" and not item.waits_for for item in items)

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
    items: Items = [*result.tests, *result.images]
    waits = view.status != "passed" and all(item.passed or item.waits_for for item in items)
    return ("good" if view.status == "passed" else "warn" if waits else "bad"), f"{tally(result)}."
