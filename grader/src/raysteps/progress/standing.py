"""Where each step stands, told from its file and its last check: nothing is built."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.errors import UsageError, reason
from raysteps.common.files import write_json
from raysteps.common.platform import own_command
from raysteps.common.text import join_and, print_plain, tenths
from raysteps.course.manifest import Step, chosen_step, course_steps, of_other_parts, taken_in
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub, same_code, tokens, unfinished_functions
from raysteps.grading.scoring import max_points
from raysteps.results.statuses import in_words
from raysteps.submission.encoding import decode
from raysteps.submission.entries import RejectedFile

if TYPE_CHECKING:  # what checks the types of documents takes long to load
    from raysteps.results.model import Results, StepResult

# What the last check of each step said; `build/check` holds the last check only, perhaps of another step.

_SCHEMA = "raysteps/progress/v1"


@dataclass(frozen=True)
class LastCheck:
    """Of one step: what it was checked with, and what came out."""

    code: str  # see code_mark
    status: str
    points: float
    max: float
    summary: str = ""


def code_mark(source: bytes) -> str:
    """Changes with the code; not with comments and white space."""
    words = "\0".join(tokens(source.decode("utf-8", "replace")))
    return hashlib.sha256(words.encode()).hexdigest()[:32]


def _place(project: Project) -> Path:
    return project.build / "progress.json"


def _summary(result: StepResult) -> str:
    """How many of each kind are right, in a few words."""
    kinds = (("tests", result.tests), ("pictures", result.images), ("hidden", result.hidden))
    return ", ".join(f"{name} {sum(item.passed for item in items)}/{len(items)}" for name, items in kinds if items)


def load_progress(project: Project) -> dict[str, LastCheck]:
    """By step id. A file that cannot be read is as good as none: the next check writes it anew."""
    try:
        table = json.loads(_place(project).read_text(encoding="utf-8"))
        if table["schema"] != _SCHEMA:
            return {}
        return {str(step): LastCheck(**entry) for step, entry in table["steps"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def save_progress(project: Project, results: Results, sources: Mapping[str, bytes]) -> None:
    """Keeps what came of a check, beside what is known of the other steps."""
    known = load_progress(project)
    for result in results.steps:
        if result.id in sources:
            mark = code_mark(sources[result.id])
            known[result.id] = LastCheck(mark, result.status, result.points, result.max, _summary(result))
    write_json(_place(project), {"schema": _SCHEMA, "steps": {step: asdict(last) for step, last in known.items()}})


Kind = Literal["missing", "unreadable", "not-started", "unchecked", "changed", "checked"]


@dataclass(frozen=True)
class StepProgress:
    """One step. `last` is what the last check said, of this code (`checked`) or of earlier code (`changed`)."""

    step: Step
    kind: Kind
    last: LastCheck | None = None
    unfinished: tuple[str, ...] = ()
    closed: str = ""  # why the file, which may hold work, cannot be opened, or which one lies in its place

    @property
    def is_done(self) -> bool:
        return self.kind == "checked" and self.last is not None and self.last.status == "passed"

    @property
    def is_broken(self) -> bool:
        """Nothing can be done with its file."""
        return self.kind in ("missing", "unreadable")

    @property
    def words(self) -> str:
        """For people."""
        match self.kind:
            case "missing":
                return "the file is not there"
            case "unreadable":
                return f"the file cannot be read: {self.closed}" if self.closed else "the file cannot be read as text"
            case "not-started":
                return in_words("not-started")
            case "unchecked":
                return "not checked yet"
        assert self.last is not None
        status = in_words(self.last.status)
        points = f"{tenths(self.last.points)} of {tenths(self.last.max)}"
        if self.kind == "changed":
            return f"changed since the last check ({status}, {points})"
        return in_words("passed") if self.is_done else ", ".join(filter(None, (status, points, self.last.summary)))


def own_source(project: Project, step: Step) -> bytes | None:
    """The student's file as it is graded, whatever encoding an editor gave it; none when it is not there."""
    try:
        return decode((project.steps / step.path).read_bytes()).source
    except FileNotFoundError:
        return None


def misplaced(project: Project, steps: Sequence[Step]) -> dict[str, str]:
    """Of steps whose files are not there, by id: which one may be meant or is taken for it, such as
    phong_shading.cpp.txt."""
    from raysteps.submission.load import load_each  # rarely, and it takes long to load

    try:
        each = load_each(project.steps, steps)
    except UsageError:  # more files than anybody looks through
        return {}

    def words(step: Step) -> str:
        found = each[step.id]
        there = f"{step.file} lies elsewhere; it belongs at steps/{step.path.as_posix()}." if found.sources else ""
        return found.notes.get(step.id) or found.remarks.get(step.id) or there

    return {step.id: words(step) for step in steps}


def step_progress(project: Project, step: Step, last: LastCheck | None) -> StepProgress:
    """Compares the file with the stub and with what was checked last."""
    try:
        source = own_source(project, step)
    except OSError as error:
        return StepProgress(step, "unreadable", closed=reason(error))
    except RejectedFile:
        return StepProgress(step, "unreadable")
    if source is None:
        return StepProgress(step, "missing")
    text = source.decode("utf-8", "replace")
    if same_code(text, pristine_stub(project, step)):
        return StepProgress(step, "not-started", unfinished=step.functions)
    left = tuple(unfinished_functions(text, step))
    if last is None or last.status == "not-started":
        return StepProgress(step, "unchecked", unfinished=left)
    return StepProgress(step, "checked" if last.code == code_mark(source) else "changed", last, left)


def standings(project: Project) -> list[StepProgress]:
    """Of all steps, in order."""
    known = load_progress(project)
    found = [step_progress(project, step, known.get(step.id)) for step in course_steps(project)]
    missing = [standing.step for standing in found if standing.kind == "missing"]
    there = misplaced(project, missing) if missing else {}
    return [replace(standing, closed=there.get(standing.step.id, standing.closed)) for standing in found]


def next_of(found: Sequence[StepProgress], after: Step | None = None) -> Step | None:
    """The first step that is not done; a bonus comes when the others are. `after`: the one beyond that step."""
    waiting = [standing.step for standing in found if not standing.is_done and standing.step != after]
    waiting.sort(key=lambda step: (after is not None and step.index < after.index, step.bonus, step.index))
    return waiting[0] if waiting else None


def chosen_or_next(project: Project, name: str | None) -> Step | None:
    """The step with this name; without a name the next one to work on, none when all are done."""
    if name is not None:
        return chosen_step(project, name)
    return next_of(standings(project))


def shown(project: Project, step: Step, name: str) -> str:
    """Where a file of the step is, as a person would type it."""
    path = project.steps / step.id / name
    try:
        return str(path.relative_to(Path.cwd()))
    except ValueError:
        return str(path)


# The commands `list` and `next`.

ALL_DONE = "All steps are done. Next: `{} finale` makes a picture, a page and a poster with them."

_OF_THE_VISIBLE_PART = "Points of the visible part, as `check` shows them; your course gives the rest."


def _points(project: Project, steps: Iterable[Step]) -> str:
    return tenths(sum(max_points(step, judged=project.has_reference) for step in steps))


def _color(standing: StepProgress) -> str:
    if standing.is_done:
        return "green"
    if standing.kind == "not-started":
        return "dim"
    bad = standing.is_broken or (standing.kind == "checked" and not _has_points(standing))
    return "red" if bad else "yellow"


def _has_points(standing: StepProgress) -> bool:
    return standing.last is not None and standing.last.points > 0


def print_list(project: Project, console: Console, found: list[StepProgress], following: Step | None) -> None:
    """One row for each step, with the points that `check` shows; an arrow stands at the next one. Where the kit has
    several parts, each has a row of its own before its steps."""
    table = Table(box=None, pad_edge=False)
    for heading in ("", "step", "", "points", "state"):
        table.add_column(heading, justify="right" if heading == "points" else "left")
    own, others = [standing.step for standing in found], of_other_parts(project)
    states = {standing.step: f"[{_color(standing)}]{escape(standing.words)}[/]" for standing in found}
    parts = sorted({step.part for step in (*own, *others)})
    for part in parts:
        steps = [step for step in (*own, *others) if step.part == part]
        if len(parts) > 1:
            table.add_row(*_heading(project, own, steps))
        for step in steps:
            title = f"{escape(step.title)}{' (bonus)' if step.bonus else ''}"
            state = states.get(step, "[dim]not in this course[/]")
            table.add_row("→" if step == following else "", step.number, title, _points(project, [step]), state)
    console.print(table)
    if not project.has_reference:
        console.print(_OF_THE_VISIBLE_PART, style="dim")


def _heading(project: Project, course: Sequence[Step], steps: Sequence[Step]) -> list[str]:
    """The row of a part with these steps: what it is worth, and how the course gets it."""
    part, bonus = steps[0].part, [step for step in steps if step.bonus]
    said = f"and up to {_points(project, bonus)} more as a bonus" if bonus else ""
    if not set(steps) & set(course):
        said = taken_in(course, part)
    return ["", "", f"[bold]Part {part}[/]", _points(project, [step for step in steps if not step.bonus]), said]


def list_steps(project: Project, console: Console) -> int:
    """Quick: nothing is built or run."""
    found = standings(project)
    following = next_of(found)
    print_list(project, console, found, following)
    own = own_command(project.root)
    steps = (f"next: {_to_type(own, standing)}" for standing in found if standing.step == following)
    console.print(f"\n{next(steps, ALL_DONE.format(own))}", highlight=False)
    return 0


def _to_type(own: str, standing: StepProgress) -> str:
    """A stub is put in the place of what is broken, but not of work that is only closed: check says what to do."""
    command = "check" if standing.closed else "reset" if standing.is_broken else "watch"
    return f"{own} {command} {standing.step.number}"


def _to_write(own: str, standing: StepProgress) -> str:
    left = standing.unfinished
    if standing.kind == "checked" and standing.last is not None and standing.last.status == "does-not-build":
        return f" (it does not build: {own} check {standing.step.number} shows where)"
    return f" ({join_and(left)} {'is' if len(left) == 1 else 'are'} still to be written)" if left else ""


def next_step(project: Project, console: Console) -> int:
    """What to work on, what to open and what to type."""
    found, own = standings(project), own_command(project.root)
    step = next_of(found)
    if step is None:
        console.print(ALL_DONE.format(own), highlight=False)
        return 0
    standing = next(each for each in found if each.step == step)
    points = f"{_points(project, [step])} points{', bonus' if step.bonus else ''}"
    console.print(
        f"[bold]{step.number} {escape(step.title)}[/bold] ({points}): {escape(standing.words)}", highlight=False
    )
    lines = [
        ("read", shown(project, step, "README.md")),
        ("write", shown(project, step, step.file) + _to_write(own, standing)),
        ("type", _to_type(own, standing)),
        ("stuck", f"{own} hint {step.number}"),
    ]
    if standing.is_broken:
        lines = [("file", shown(project, step, step.file)), ("type", _to_type(own, standing))]
    for label, text in lines:
        print_plain(console, f"  {label:<6} {text}")
    return 0
