"""Where each step stands, told from its file and its last check: nothing is built."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from raysteps.commands.course.remembered import LastCheck, code_mark, recall
from raysteps.common.text import number
from raysteps.kit.manifest import Step, choose, read_steps
from raysteps.kit.project import Project
from raysteps.kit.stubs import pristine_stub, same_code, unfinished_functions
from raysteps.submission.encoding import decode
from raysteps.submission.entries import NotTaken

Kind = Literal["missing", "unreadable", "not-started", "unchecked", "changed", "checked"]


@dataclass(frozen=True)
class Standing:
    """One step. `last` is what the last check said, of this code (`checked`) or of earlier code (`changed`)."""

    step: Step
    kind: Kind
    last: LastCheck | None = None
    unfinished: tuple[str, ...] = ()

    @property
    def is_done(self) -> bool:
        return self.kind == "checked" and self.last is not None and self.last.status == "passed"

    @property
    def words(self) -> str:
        """For people."""
        match self.kind:
            case "missing":
                return "the file is missing"
            case "unreadable":
                return "the file cannot be read as text"
            case "not-started":
                return "not started"
            case "unchecked":
                return "not checked yet"
        assert self.last is not None
        status = self.last.status.replace("-", " ")
        points = f"{number(self.last.points)} of {number(self.last.max)}"
        if self.kind == "changed":
            return f"changed since the last check ({status}, {points})"
        return "passed" if self.is_done else ", ".join(filter(None, (status, points, self.last.summary)))


def own_source(project: Project, step: Step) -> bytes | None:
    """The student's file as it is graded, whatever encoding an editor gave it; none when it is not there."""
    try:
        return decode((project.steps / step.path).read_bytes()).source
    except FileNotFoundError:
        return None


def standing_of(project: Project, step: Step, last: LastCheck | None) -> Standing:
    """Compares the file with the stub and with what was checked last."""
    try:
        source = own_source(project, step)
    except (OSError, NotTaken):
        return Standing(step, "unreadable")
    if source is None:
        return Standing(step, "missing")
    text = source.decode("utf-8", "replace")
    if same_code(text, pristine_stub(project, step)):
        return Standing(step, "not-started", unfinished=step.functions)
    left = tuple(unfinished_functions(text, step))
    if last is None or last.status == "not-started":
        return Standing(step, "unchecked", unfinished=left)
    return Standing(step, "checked" if last.code == code_mark(source) else "changed", last, left)


def standings(project: Project) -> list[Standing]:
    """Of all steps, in order."""
    known = recall(project)
    return [standing_of(project, step, known.get(step.id)) for step in read_steps(project)]


def next_of(found: Sequence[Standing], after: Step | None = None) -> Step | None:
    """The first step that is not done; a bonus comes when the others are. `after`: the one beyond that step."""
    waiting = [standing.step for standing in found if not standing.is_done and standing.step != after]
    waiting.sort(key=lambda step: (after is not None and step.index < after.index, step.bonus, step.index))
    return waiting[0] if waiting else None


def chosen_or_next(project: Project, name: str | None) -> Step | None:
    """The step with this name; without a name the next one to work on, none when all are done."""
    if name is not None:
        return choose(read_steps(project), [name])[0]
    return next_of(standings(project))


def shown(project: Project, step: Step, name: str) -> str:
    """Where a file of the step is, as a person would type it."""
    path = project.steps / step.id / name
    try:
        return str(path.relative_to(Path.cwd()))
    except ValueError:
        return str(path)
