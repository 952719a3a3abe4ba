"""The commands `list` and `next`."""

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.commands.course.standing import Standing, next_of, shown, standings
from raysteps.common.systems import own_command
from raysteps.common.text import listed, number
from raysteps.grading.scoring import most_points
from raysteps.kit.manifest import Step
from raysteps.kit.project import Project

_ALL_DONE = "All steps are done. `./raysteps render` draws any scene in scenes/ with them."

_OF_THE_VISIBLE_PART = "Points of the visible part, as `check` shows them; your course gives the rest."


def _points(project: Project, step: Step) -> str:
    return number(most_points(step, judged=project.has_reference))


def _color(standing: Standing) -> str:
    if standing.is_done:
        return "green"
    if standing.kind == "not-started":
        return "dim"
    bad = standing.kind in ("missing", "unreadable") or (standing.kind == "checked" and not _has_points(standing))
    return "red" if bad else "yellow"


def _has_points(standing: Standing) -> bool:
    return standing.last is not None and standing.last.points > 0


def print_list(project: Project, console: Console, found: list[Standing], following: Step | None) -> None:
    """One row for each step, with the points that `check` shows; an arrow stands at the next one."""
    table = Table(box=None, pad_edge=False)
    for heading in ("", "step", "", "points", "state"):
        table.add_column(heading, justify="right" if heading == "points" else "left")
    for standing in found:
        step, color = standing.step, _color(standing)
        title = f"{escape(step.title)}{' (bonus)' if step.bonus else ''}"
        state = f"[{color}]{escape(standing.words)}[/{color}]"
        table.add_row("→" if step == following else "", step.number, title, _points(project, step), state)
    console.print(table)
    if not project.has_reference:
        console.print(_OF_THE_VISIBLE_PART, style="dim")


def list_steps(project: Project, console: Console) -> int:
    """Quick: nothing is built or run."""
    found = standings(project)
    following = next_of(found)
    print_list(project, console, found, following)
    told = f"next: {own_command()} watch {following.number}" if following is not None else _ALL_DONE
    console.print(f"\n{told}", highlight=False)
    return 0


def _to_write(standing: Standing) -> str:
    left = standing.unfinished
    return f" ({listed(left)} {'is' if len(left) == 1 else 'are'} still to be written)" if left else ""


def next_step(project: Project, console: Console) -> int:
    """What to work on, what to open and what to type."""
    found = standings(project)
    step = next_of(found)
    if step is None:
        console.print(_ALL_DONE, highlight=False)
        return 0
    standing = next(each for each in found if each.step == step)
    points = f"{_points(project, step)} points{', bonus' if step.bonus else ''}"
    console.print(
        f"[bold]{step.number} {escape(step.title)}[/bold] ({points}): {escape(standing.words)}", highlight=False
    )
    lines = [
        ("read", shown(project, step, "README.md")),
        ("write", shown(project, step, step.file) + _to_write(standing)),
        ("type", f"{own_command()} watch {step.number}"),
        ("stuck", f"{own_command()} hint {step.number}"),
    ]
    if standing.kind in ("missing", "unreadable"):
        lines = [("file", shown(project, step, step.file)), ("type", f"{own_command()} reset {step.number}")]
    for label, text in lines:
        console.print(f"  {label:<6} {escape(text)}", highlight=False, soft_wrap=True)
    return 0
