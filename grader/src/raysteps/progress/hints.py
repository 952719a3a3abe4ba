"""The command `hint`: one hint at a time, from a question to pseudocode."""

import json
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import UsageError
from raysteps.common.files import write_json
from raysteps.common.platform import own_command
from raysteps.common.text import count
from raysteps.course.manifest import Step
from raysteps.course.project import Project

_SCHEMA = "raysteps/hints/v1"


@dataclass(frozen=True)
class Hint:
    """`level` counts from 1."""

    level: int
    of: int
    text: str

    @property
    def left(self) -> str:
        """What comes after it, in words."""
        rest = self.of - self.level
        return f"{count(rest, 'more hint')} for this step" if rest else "that was the last hint of this step"


class Hints:
    """Those of all steps, and how many of each were read."""

    def __init__(self, project: Project) -> None:
        self._place = project.build / "hints.json"

    def _read(self) -> dict[str, int]:
        try:
            table = json.loads(self._place.read_text(encoding="utf-8"))
            if table["schema"] != _SCHEMA:
                return {}
            return {str(step): int(level) for step, level in table["read"].items()}
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return {}

    def reached(self, step: Step) -> int:
        """How many of its hints were read."""
        return min(max(self._read().get(step.id, 0), 0), len(step.hints))

    def _reach(self, step: Step, level: int) -> None:
        if level > self.reached(step):
            write_json(self._place, {"schema": _SCHEMA, "read": self._read() | {step.id: level}})

    def level(self, step: Step, level: int) -> Hint:
        """One of them."""
        if not 1 <= level <= len(step.hints):
            raise UsageError(
                f"--level {level}: step {step.number} has {count(len(step.hints), 'hint')}, from level 1 on"
            )
        self._reach(step, level)
        return Hint(level, len(step.hints), step.hints[level - 1].strip("\n"))

    def following(self, step: Step) -> Hint | None:
        """The next one; none where there is no other, see `no_other`."""
        reached = self.reached(step)
        return self.level(step, reached + 1) if reached < len(step.hints) else None

    def seen(self, step: Step) -> list[Hint]:
        """Those that were read."""
        return [self.level(step, level) for level in range(1, self.reached(step) + 1)]


def no_other(step: Step, root: Path | None = None) -> str:
    """That all hints were read, and where to go on. `root`: of the kit, where it is told on a command line."""
    own = own_command(root)
    handout = f"steps/{step.id}/README.md"
    if not step.hints:
        return f"Step {step.number} has no hints. What to do stands in {handout}."
    all_hints = f"all {count(len(step.hints), 'hint')}" if len(step.hints) > 1 else "the only hint"
    return (
        f"You have read {all_hints} of step {step.number}; `{own} hint {step.number} --again` shows them.\n"
        f'Go on in {handout}: "A worked example" and "Wrong pictures and their causes".\n'
        f"`{own} inspect SCENE X Y --step {step.index}` follows one wrong pixel."
    )


def _print(console: Console, step: Step, hints: list[Hint], own: str) -> None:
    for hint in hints:
        console.print(f"[bold]{escape(step.title)}[/bold], hint {hint.level} of {hint.of}", highlight=False)
        console.print(escape(hint.text), highlight=False)
        console.print()
    last = hints[-1]
    more = f": {own} hint {step.number}" if last.level < last.of else ""
    console.print(f"{last.left}{more}", style="dim", highlight=False)


def _say(console: Console, text: str) -> None:
    console.print(escape(text), highlight=False)


def print_hint(
    project: Project, step: Step, console: Console, *, level: int | None = None, all_: bool = False, again: bool = False
) -> int:
    """The next one, or those that were asked for."""
    hints, own = Hints(project), own_command(project.root)
    if not step.hints:
        _say(console, no_other(step, project.root))
    elif all_:
        _print(console, step, [hints.level(step, each) for each in range(1, len(step.hints) + 1)], own)
    elif again:
        seen = hints.seen(step)
        if seen:
            _print(console, step, seen, own)
        else:
            console.print(f"No hint of step {step.number} was read yet: {own} hint {step.number}", highlight=False)
    else:
        hint = hints.level(step, level) if level is not None else hints.following(step)
        if hint is None:
            _say(console, no_other(step, project.root))
        else:
            _print(console, step, [hint], own)
    return 0
