"""Prints results for people."""

import sys
from collections.abc import Callable
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.status import Status
from rich.table import Table
from rich.text import Text

from raysteps.common.platform import kit_command
from raysteps.common.text import mean, size, tenths
from raysteps.course.manifest import Step
from raysteps.report.wording import (
    HOW_SURE,
    SaidOnce,
    ended,
    inspect_worst,
    percent,
    result_with_folder,
    total_words,
    warnings_of,
)
from raysteps.results.model import Diagnosis, HiddenResult, ImageResult, Results, StepResult, TestResult, Work
from raysteps.toolchain.kit_artifacts import ProgressCallback

Again = Callable[[str], str]  # the command for a case, by its place beside results.json

_TOGETHER = (
    "together: is the step's first picture also right with your own earlier steps? The reference stands in for those "
    "that are wrong or left out"
)
_VISIBLE = "tests and pictures with your own steps before each; your course may test hidden inputs, too"
_COLORS = {"passed": "green", "partial": "yellow", "not-started": "dim"}


def _status(result: StepResult) -> str:
    color = "red" if result.not_taken else _COLORS.get(result.status, "red")
    return f"[{color}]{result.shown.words}[/{color}]"


def _points(result: StepResult) -> str:
    return f"{tenths(result.points)} of {tenths(result.max)}" + (" bonus" if result.bonus else "")


_INDENT = 13
_LABEL = 10


def _print_hanging(console: Console, head: str, text: str) -> None:
    """The text behind its head, which is markup; what does not fit on the line stands below the text's beginning."""
    first = Text.from_markup(head)
    lines = Text(text).wrap(console, max(console.width - first.cell_len, 20)) or [Text()]
    for line in lines:
        line.rstrip()
        console.print(first + line, soft_wrap=True)
        first = Text(" " * first.cell_len)


def _print_labelled(console: Console, label: str, text: str) -> None:
    _print_hanging(console, " " * _INDENT + f"{label:<{_LABEL}}", text)


def _print_below(console: Console, text: str) -> None:
    _print_hanging(console, " " * _INDENT, text)


def _print_diagnosis(console: Console, diagnosis: Diagnosis) -> None:
    """The word before it says how sure one can be."""
    word = HOW_SURE[diagnosis.kind]
    seen = ", ".join(diagnosis.seen_in) if diagnosis.kind != "finding" else ""
    where = f" (seen in {seen})" if seen else ""
    _print_hanging(console, f"  [bold yellow]{word}[/bold yellow]  ", diagnosis.title + where)
    for other in diagnosis.alike:
        _print_hanging(console, " " * _INDENT + "or  ", other)
    for label, text in (("you see", diagnosis.sees), ("cause", diagnosis.cause), ("hint", diagnosis.hint)):
        if text:
            _print_labelled(console, label, text)


def _print_test(console: Console, test: TestResult, once: SaidOnce) -> None:
    how = ended(test.outcome)
    _print_hanging(console, "  [red]test[/red]     ", f"{test.name}{f': {how}' if how else ''}")
    if test.expression:
        _print_labelled(console, "expected", test.expression)
        _print_labelled(console, "got", test.expanded)
    for line in once(test.message, test.outcome).splitlines():
        _print_below(console, line)
    if test.location:
        console.print(f"             [dim]{escape(test.location)}[/dim]")


def _work_lines(mine: Work, reference: Work) -> list[str]:
    """What a picture cost, beside the reference; clocks differ, counters do not."""

    def per_ray(work: Work) -> tuple[str, str]:
        return mean(work.surfaces_per_ray), mean(work.boxes_per_ray)

    surfaces, boxes = per_ray(mine)
    return [
        f"per ray {surfaces} surfaces and {boxes} boxes tested; the reference: {' and '.join(per_ray(reference))}",
        f"{mine.references} entries in {mine.boxes} boxes, {size(mine.bytes)}; the reference: "
        f"{reference.references} in {reference.boxes}, {size(reference.bytes)}",
    ]


def _print_image(console: Console, image: ImageResult, out: Path, once: SaidOnce) -> None:
    color = "green" if image.passed else "red"
    how = ended(image.outcome)
    share = "" if image.wrong_share is None else f"{image.wrong_share:.2%}"
    noisy = "no more off than chance explains" if image.passed else f"{share} of its parts wrong"
    found = f"  {noisy if image.noisy else f'{share} wrong'}"
    words = f": {how}" if how else "" if not share or share in image.message else found
    console.print(f"  [{color}]picture[/{color}]  {escape(image.name)}{words}")
    if not image.passed:
        message = once(image.message, image.outcome)
        if message:
            _print_below(console, message)
        if image.difference or image.mine:
            shown = out / (image.difference or image.mine or "")
            console.print(f"             see {escape(short_path(shown))}")
    if image.work is not None and image.reference_work is not None:
        for line in _work_lines(image.work, image.reference_work):
            console.print(f"             {line}", style="dim", highlight=False)


def _print_tier(console: Console, result: StepResult, step: Step) -> None:
    """What the tree has reached by counted work, and what each tier takes."""
    from raysteps.results.work_ratio import work_tier  # few steps have tiers

    tier = work_tier(result, step)
    if tier is not None:
        console.print(f"  tree     {escape(tier.reached)}", highlight=False)
        console.print(f"             {tier.to_reach}", style="dim", highlight=False)


def _print_hidden(console: Console, item: HiddenResult, again: Again, once: SaidOnce) -> None:
    console.print(f"  [red]hidden[/red]   {escape(item.name)}: {percent(item.share)} of its points")
    message = once(item.message, item.outcome).removeprefix(f"{item.name}: ")
    if message:
        _print_below(console, message)
    for label, text in (("given", item.given), ("expected", item.expected), ("got", item.actual)):
        if text:
            _print_labelled(console, label, text)
    if item.case:
        console.print(f"             {'again':<9} {escape(again(item.case))}", soft_wrap=True)


def short_path(path: Path) -> str:
    """Relative to where the person is, when that is shorter."""
    try:
        return str(path.relative_to(Path.cwd()))
    except ValueError:
        return str(path)


def print_details(
    console: Console, results: Results, steps: list[Step], out: Path, again: Again, *, own: bool = False
) -> None:
    """What happened in each step: what failed, in full, and what passed in one line. `again` is the command that asks a
    case once more; `own`: the steps are those in the repository, so that `inspect` sees what they do, and what explains
    them comes last, by `print_diagnoses`: where their student looks first."""
    known = {step.id: step for step in steps}
    for result in [result_with_folder(one, known[one.id]) for one in results.steps] if own else results.steps:
        console.print(
            f"\n[bold]{result.id}[/bold] {escape(known[result.id].title)}: {_status(result)}, {_points(result)}"
        )
        for message in result.messages:
            for line in message.splitlines():
                _print_hanging(console, "  ", line)
        for warning, *more in warnings_of(result) if own else ():
            _print_hanging(console, "  [yellow]warning[/yellow]  ", warning)
            for line in more:
                _print_below(console, line)
        once = SaidOnce(result.messages)
        for diagnosis in () if own else result.diagnoses:
            _print_diagnosis(console, diagnosis)
        for test in result.tests:
            if not test.passed and not test.waits_for:
                _print_test(console, test, once)
        if result.tests and all(test.passed for test in result.tests):
            console.print(f"  [green]tests[/green]    all {len(result.tests)} passed")
        for image in result.images:
            if not image.waits_for:
                _print_image(console, image, out, once)
                worst = inspect_worst(known[result.id], image, out) if own else None
                if worst is not None:
                    console.print(f"{' ' * _INDENT}{'worst':<{_LABEL}}{escape(kit_command(*worst))}", soft_wrap=True)
        if known[result.id].is_about_a_tree:
            _print_tier(console, result, known[result.id])
        for item in result.hidden:
            if not item.passed and not item.waits_for:
                _print_hidden(console, item, again, once)
        if result.hidden and all(item.passed for item in result.hidden):
            console.print(f"  [green]hidden[/green]   all {len(result.hidden)} passed")
        if result.cumulative.message and result.tests:
            _print_hanging(console, "  together  ", result.cumulative.message)


def print_diagnoses(console: Console, results: Results, steps: list[Step]) -> None:
    """What explains the wrong steps, in one place, which takes seconds to find out or is known already."""
    known = {step.id: step for step in steps}
    for result in [result_with_folder(one, known[one.id]) for one in results.steps]:
        if result.diagnoses:
            console.print(f"\n[bold]{result.id}[/bold]")
            for diagnosis in result.diagnoses:
                _print_diagnosis(console, diagnosis)
    console.print()


def print_table(console: Console, results: Results, *, visible_only: bool = False) -> None:
    """One row per step and the total. `visible_only`: there is no judge, as in a students' kit."""
    table = Table(title=escape(results.submission), title_justify="left")
    headings = ["step", "status", "visible points" if visible_only else "points", "tests", "pictures"]
    for heading in headings if visible_only else [*headings, "hidden", "together"]:
        table.add_column(heading)
    for result in results.steps:
        ran = bool(result.tests or result.images)
        row = [
            result.id,
            _status(result),
            _points(result),
            f"{sum(test.passed for test in result.tests)}/{len(result.tests)}" if ran else "",
            f"{sum(image.passed for image in result.images)}/{len(result.images)}" if ran else "",
            f"{sum(item.passed for item in result.hidden)}/{len(result.hidden)}" if result.hidden else "",
            ("right" if result.cumulative.passed else "wrong") if ran else "",
        ]
        table.add_row(*row[: len(table.columns)])
    console.print(table)
    console.print(_VISIBLE if visible_only else _TOGETHER, style="dim", soft_wrap=True)
    console.print(total_words(results.total, visible_only=visible_only))


def print_isolation(console: Console, results: Results) -> None:
    """What kept the student's code apart."""
    console.print(
        f"Isolation: {escape(results.isolation.name)}. {escape(results.isolation.description)}", highlight=False
    )


def print_files(console: Console, path: Path, page: Path | None) -> None:
    """Where the results are."""
    if page is not None:
        console.print(f"Report: {escape(short_path(page))}, for a browser", soft_wrap=True)
    console.print(f"Results: {escape(short_path(path))}, pictures beside it", soft_wrap=True)


# Tells what is being done.


def progress(console: Console, status: Status) -> ProgressCallback:
    """Beside the spinner on a terminal, elsewhere as lines on stderr."""

    def say(text: str) -> None:
        if console.is_terminal:
            status.update(text)
        else:
            sys.stderr.write(f"raysteps: {text}\n")  # in one piece: several threads say something
            sys.stderr.flush()

    return say
