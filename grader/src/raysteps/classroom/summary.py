"""What is printed while a class is graded, and when it has been."""

import sys
import time
from pathlib import Path
from types import TracebackType

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn
from rich.table import Table

from raysteps.classroom.database import CLASS_JSON, SUBMISSIONS
from raysteps.classroom.late_policy import BY_FILE
from raysteps.common.text import count, first_line, number, tenths
from raysteps.report.class_overview import has_unread_files, is_late_by_file
from raysteps.report.class_page import FILE as CLASS_PAGE
from raysteps.results.class_model import ClassResults, GradedSubmission, NotedStudent
from raysteps.results.statuses import NOT_TAKEN, NOT_TAKEN_STATUS, Status, in_words

# Shows how far a class is: a bar on a terminal, lines elsewhere.


def _span(seconds: float) -> str:
    if seconds < 90:
        return f"{max(1, round(seconds))} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 90 else f"{minutes // 60} h {minutes % 60} min"


class ProgressMeter:
    """Counts submissions, so many of them `at_once`. What was graded before takes no time and says nothing about the
    time left, nor does what is made once before the first: kit, known mistakes."""

    def __init__(self, console: Console, total: int, at_once: int) -> None:
        self._console = console
        self._total = total
        self._at_once = at_once
        self._done = 0
        self._graded = 0
        self._first = 0.0  # when that one was graded
        self._bar: Progress | None = None
        if console.is_terminal:
            columns = (
                TextColumn("{task.description}"),
                BarColumn(),
                MofNCompleteColumn(),
                TextColumn("{task.fields[left]}"),
            )
            self._bar = Progress(*columns, console=console, transient=True)
            self._task = self._bar.add_task("grading", total=total, left="")

    def __enter__(self) -> "ProgressMeter":
        if self._bar is not None:
            self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.stop()

    def say(self, text: str) -> None:
        """A line of its own."""
        if self._bar is not None:
            self._bar.console.print(escape(text), soft_wrap=True)
        else:
            print(f"raysteps: {text}", file=sys.stderr, flush=True)

    def _left(self) -> str:
        """Nothing until one was graded that began after another's end: those that begin at once end at about the time
        of the first."""
        left = self._total - self._done
        if self._graded <= self._at_once or not left:
            return ""
        return f"about {_span((time.monotonic() - self._first) / (self._graded - self._at_once) * left)} left"

    def skip(self) -> None:
        """One that need not be graded."""
        self._done += 1
        if self._bar is not None:
            self._bar.update(self._task, completed=self._done)

    def count(self, name: str, what: str) -> None:
        """One that was graded."""
        self._done += 1
        self._graded += 1
        self._first = self._first or time.monotonic()
        left = self._left()
        if self._bar is not None:
            self._bar.update(self._task, completed=self._done, description=escape(name), left=left)
        else:
            self.say(f"{self._done} of {self._total}: {name}: {what}" + (f"; {left}" if left else ""))


_MARKS: dict[Status, str] = {"does-not-build": "b", "crashed": "c", "timeout": "t", "not-started": "-"}
_SIGNS = {str(status): mark for status, mark in _MARKS.items()}
_NOT_TAKEN = "n"
_MAX_MISTAKES = 10


def _cell(one: GradedSubmission, step_id: str) -> str:
    step = one.steps.get(step_id)
    if step is None:
        return ""
    if one.shown_status(step_id) == NOT_TAKEN_STATUS:
        return f"[red]{_NOT_TAKEN}[/red]"
    mark = _SIGNS.get(step.status, "")
    idle = mark == "-" and not step.points  # somebody may have given points for it
    shown = mark if idle else f"{tenths(step.points)} {mark}".rstrip()
    color = "green" if step.status == "passed" else "dim" if idle else "yellow" if step.points else "red"
    return f"[{color}]{shown}[/{color}]"


def _legend(document: ClassResults) -> str:
    """Of the marks that the table has."""
    there = {step.status for one in document.submissions for step in one.steps.values()}
    marks = [f"{mark} {in_words(status)}" for status, mark in _MARKS.items() if status in there]
    marks += [f"{_NOT_TAKEN} {NOT_TAKEN.words}"] if any(one.unread_steps for one in document.submissions) else []
    return ", ".join([*marks, *(["* bonus"] if any(step.bonus for step in document.steps) else [])])


def _total(one: GradedSubmission) -> str:
    if one.points is None:
        return f"[red]{one.status}[/red]"
    return tenths(one.points)


def _is_late(document: ClassResults) -> bool:
    """Whether there is anything to say about days: else the final points are the total."""
    return any(one.late is not None and one.late.days for one in document.submissions)


def _table(document: ClassResults) -> Table:
    steps = document.steps
    late = _is_late(document)
    table = Table()
    table.add_column("submission", overflow="fold")
    for step in steps:
        table.add_column(f"{step.id[:2]}{'*' if step.bonus else ''}\n{number(step.points)}", justify="right")
    regular = sum(step.points for step in steps if not step.bonus)
    table.add_column(f"total\n{number(regular)}", justify="right")
    if late:
        table.add_column("days\nlate", justify="right")
        table.add_column("final", justify="right")
    for one in document.submissions:
        cells = [escape(one.name), *(_cell(one, step.id) for step in steps), _total(one)]
        if late and one.late is not None:
            cells += [str(one.late.days or ""), number(one.late.points)]
        table.add_row(*cells)
    return table


_MANY = 12  # of those who handed nothing in: more would hide what else there is to see


def _print_list(console: Console, heading: str, lines: list[str]) -> None:
    if lines:
        console.print(f"\n[bold]{heading}[/bold]")
        for line in lines:
            console.print(f"  {escape(line)}", soft_wrap=True)


def _points(value: float | None) -> str:
    return "no points" if value is None else number(value)


def _who(student: NotedStudent) -> str:
    words = " ".join(filter(None, (student.id, student.name, student.email)))
    return f"{words}: {student.note}" if student.note else words


def _late_by_file(document: ClassResults) -> list[str]:
    """Copying or unpacking may have set that time: it should not cost points unseen."""
    return [
        f"{one.name}: {one.submitted_at}, {count(one.late.days, 'day')} begun, {number(one.late.percent)} % off"
        for one in document.submissions
        if one.late is not None and is_late_by_file(one)
    ]


def _mean(document: ClassResults) -> str:
    """How the class stands, and what that counts."""
    facts = document.statistics
    lateness = " after lateness" if document.late_policy is not None else ""
    bonus = sum(step.points for step in document.steps if step.bonus)
    regular = sum(step.points for step in document.steps if not step.bonus)
    on_top = f", with up to {number(bonus)} more as a bonus" if bonus else ""
    points = (
        f"mean {_points(facts.mean)}, median {_points(facts.median)} points{lateness}, of {number(regular)}{on_top}"
    )
    unread = len(document.unreadable)
    others = f"; without the {unread} that could not be read" if unread else ""
    return f"{count(facts.graded, 'submission')} graded: {points}{others}"


def _mistakes(document: ClassResults) -> list[str]:
    """What several did."""
    common = [found for found in document.mistakes if found.submissions > 1][:_MAX_MISTAKES]
    return [f"{found.submissions} in {found.step}: {found.title}" for found in common]


def _print_apart(console: Console, document: ClassResults) -> None:
    """What a table cannot say."""
    by_name = {one.name: one for one in document.submissions}
    faults = [f"{name}: {first_line(by_name[name].fault)}" for name in document.faults]
    _print_list(console, "Not graded because of a fault of the grader; --resume tries again unless it gave up", faults)
    missing = ", or a shard is missing" if any(run.shard != "1/1" for run in document.runs) else ""
    _print_list(console, f"Not graded yet; --resume goes on{missing}", document.not_graded)
    _print_list(console, "With an earlier result, because what is there now is not graded yet", document.outdated)
    unread = [f"{name}: {' '.join(by_name[name].why_unread)}" for name in document.unreadable]
    _print_list(console, "Nothing could be read of these, so they have 0 points", unread)
    files = [f"{one.name}: {words}" for one in document.submissions if has_unread_files(one) for words in one.not_taken]
    _print_list(console, "Files that could not be read, so their steps have 0 points", files)
    _print_list(console, f"Late {BY_FILE}, where the roster has no submitted_at", _late_by_file(document))
    _print_list(console, "The most common mistakes, by submissions", _mistakes(document))
    changed = [
        f"{one.name}: {_points(one.before)} before, {_points(one.after)} now{one.why}" for one in document.changed
    ]
    _print_list(console, "Changed since the last time, as the grader gave them", changed)
    again = [f"{one.name}: {words}" for one in document.submissions for words in one.review.look_again]
    _print_list(console, "Points that a person changed, to look at again", again)
    _print_list(
        console,
        "Open regrade requests",
        [f"{one.name}: {one.review.open_requests}" for one in document.submissions if one.review.open_requests],
    )
    absent = [_who(one) for one in document.students_without_submission]
    if len(absent) > _MANY:
        absent = [f"{count(len(absent), 'student')}; results.csv names them"]
    _print_list(console, "On the roster, but without a submission", absent)
    _print_list(console, "With more than one submission", [_who(one) for one in document.students_with_several])
    notes = [f"{name}: {by_name[name].note}" for name in document.submissions_without_student]
    _print_list(console, "Without a student on the roster", notes)
    _print_list(console, "Graded earlier, but no longer in the folder", document.gone)
    _print_list(console, "Extensions for ids that nobody has", document.unknown_extensions)


def print_summary(console: Console, document: ClassResults, out: Path) -> None:
    """The table, what needs a person's eye, and where the files are."""
    console.print(_table(document))
    if _legend(document):
        console.print(f"[dim]{_legend(document)}[/dim]")
    _print_apart(console, document)
    console.print()
    if document.statistics.graded:
        console.print(_mean(document))
    if document.late_policy is not None and not _is_late(document):
        console.print("Nobody was late")
    reused = document.run.reused
    if reused:
        console.print(f"{count(reused, 'result')} of an earlier run still hold and were not made anew")
    isolations = sorted({one.isolation for one in document.submissions if one.isolation})
    if isolations:
        console.print(f"Isolation: {', '.join(isolations)}")
    console.print(
        f"Table: {escape(str(out / 'results.csv'))}, all facts: {escape(str(out / CLASS_JSON))}", soft_wrap=True
    )
    console.print(f"Page: {escape(str(out / CLASS_PAGE))}", soft_wrap=True)
    console.print(f"Per submission: {escape(str(out / SUBMISSIONS))}", soft_wrap=True)
