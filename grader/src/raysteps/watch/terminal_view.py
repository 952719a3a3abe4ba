"""Compact lines for the terminal: the page has the rest."""

import textwrap
from collections.abc import Sequence
from dataclasses import replace

from rich.console import Console
from rich.markup import escape

from raysteps.common.text import count, shorten
from raysteps.report.wording import (
    HOW_SURE,
    replay_command,
    result_with_folder,
    tests_with_folder,
    warnings_of,
    watch_command,
)
from raysteps.results.model import HiddenResult, StepResult, TestResult
from raysteps.results.statuses import NOT_BUILT
from raysteps.watch.step_view import StepView, Tone, verdict

_COLORS: dict[Tone, str] = {"good": "bold green", "bad": "bold red", "warn": "bold yellow", "plain": "bold"}
_SIGNS: dict[Tone, str] = {"good": "✓", "bad": "✗", "warn": "!", "plain": "·"}
_MAX_CHARACTERS = 600
_MAX_FAILED = 2

KEYS = (
    ("h", "hint"),
    ("n", "next step"),
    ("l", "list"),
    ("i", "inspect"),
    ("c", "check all"),
    ("r", "reset"),
    ("space", "again"),
    ("?", "help"),
    ("q", "quit"),
)
HELP = """h      the next hint of this step
n      go on to the next step that is not done
l      the steps, and where you stand
i      look into the pixel that is most wrong
c      check all of this step now, and count the points
r      put the stub back (asks first; your file is kept)
space  build, test and draw once more
q      quit"""


def _is_news(test: TestResult, looked: Sequence[TestResult]) -> bool:
    """Whether a check says of a test what the look before it did not, such as the line at which it crashes. How long
    a test hung is none."""
    return test.outcome != "timeout" and all(
        (test.name, test.message) != (other.name, other.message) for other in looked
    )


def _with_folder(view: StepView) -> StepView:
    if view.result is None:
        return view
    looked = tuple(tests_with_folder(view.looked, view.step))
    return replace(view, result=result_with_folder(view.result, view.step), looked=looked)


class TerminalView:
    """Prints; knows nothing of what happens next."""

    def __init__(self, console: Console) -> None:
        self.console = console

    def command(self, text: str, style: str = "") -> None:
        """What somebody may want to copy: not broken into lines. Nothing in it is markup."""
        self.console.print(escape(text), style=style, highlight=False, soft_wrap=True)

    def line(self, text: str, style: str = "") -> None:
        """Shortened, and in a terminal broken between words, so that the rest stands below the first word."""
        text = shorten(text, _MAX_CHARACTERS)
        if not self.console.is_terminal:
            self.command(text, style)
            return
        indent = " " * (len(text) - len(text.lstrip()))
        parts = textwrap.wrap(
            text.strip(),
            max(self.console.width - 1, 20),
            initial_indent=indent,
            subsequent_indent=indent + "  ",
            break_long_words=False,
            break_on_hyphens=False,
        )
        for part in parts or [""]:
            self.command(part, style)

    def dim(self, text: str) -> None:
        self.line(text, "dim")

    def begin(self, view: StepView, why: str) -> None:
        title = f"{view.saved}  {view.step.number} {view.step.title}: {why}"
        if self.console.is_terminal:
            self.console.rule(f"[dim]{escape(title)}[/dim]", align="left", style="dim")
        else:
            self.line(title)

    def result(self, view: StepView) -> None:
        """What came of a look or of a check."""
        view = _with_folder(view)
        tone, text = verdict(view)
        took = f"  ({view.seconds:.1f} s)" if view.seconds is not None and not view.full and tone != "plain" else ""
        self.line(f"{_SIGNS[tone]} {text}{took}", _COLORS[tone])
        if view.result is None or view.problem or view.gone:
            return
        if view.status in ("does-not-build", "not-started"):
            for message in view.result.messages:
                for line in message.removeprefix(NOT_BUILT).splitlines():
                    self.line(f"  {line}")
            return
        if view.full:
            self._tests([test for test in view.failed_tests if _is_news(test, view.looked)][:1])
        else:
            for message in view.result.messages:
                self.line(f"  {message}")
            self._warnings(view.result)
            self._tests(view.failed_tests)
            self._pictures(view.result)
        self._diagnoses(view.result)
        self._hidden(view.missed)
        together = view.result.cumulative
        if view.full and not view.is_done and not together.passed and together.message:
            self.line(f"  together: {together.message}")
        if view.following is not None:
            step = view.following
            self.command(f"next: {step.number} {step.title}. Press n, or type {watch_command(step.id)}", "bold")

    def _warnings(self, result: StepResult) -> None:
        for first, *more in warnings_of(result):
            self.line(f"  warning  {first}", "yellow")
            for line in more:
                self.line(f"    {line}")

    def _diagnoses(self, result: StepResult) -> None:
        for found in result.diagnoses[:1]:
            self.line(f"  {HOW_SURE[found.kind]}: {found.title}", "yellow")
            for text in filter(None, (found.sees, found.cause, found.hint)):
                self.line(f"    {text}")

    def _tests(self, failed: Sequence[TestResult]) -> None:
        for test in failed[:_MAX_FAILED]:
            self.line(f"  test  {test.name}", "red")
            if test.expression:
                self.line(f"    expected  {test.expression}")
                self.line(f"    got       {test.expanded}")
            for line in test.message.splitlines()[:3]:
                self.line(f"    {line}")
        self._more(len(failed), "test")

    def _pictures(self, result: StepResult) -> None:
        for image in result.images:
            if not image.passed:
                self.line(f"  picture  {image.name}: {image.message}", "" if image.waits_for else "red")

    def _hidden(self, missed: Sequence[HiddenResult]) -> None:
        for item in missed[:_MAX_FAILED]:
            self.line(f"  hidden  {item.name}: {item.message.removeprefix(f'{item.name}: ')}", "red")
            for label, text in (("given", item.given), ("expected", item.expected), ("got", item.actual)):
                if text:
                    self.line(f"    {label:<9} {text}")
            if item.case:
                self.command(f"    again     {replay_command(item.case)}")
        self._more(len(missed), "hidden item")

    def _more(self, amount: int, noun: str) -> None:
        if amount > _MAX_FAILED:
            self.dim(f"  … and {count(amount - _MAX_FAILED, f'more {noun}')}: see the page")

    def keys(self) -> None:
        """The reminder below each result."""
        self.console.print("  ".join(f"[bold]{key}[/bold] {does}" for key, does in KEYS), style="dim", highlight=False)

    def help(self) -> None:
        self.console.print(HELP, highlight=False)
