"""A kit without programs: manifests and stubs only, enough for what builds nothing."""

import io
import shutil
from pathlib import Path

from rich.console import Console

from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project, here
from raysteps.course.stubs import stub_for
from raysteps.results.model import Results, StepResult


def small_project(root: Path) -> Project:
    """Nobody has written anything yet, and there are no solutions."""
    copy = Project(root)
    for step in read_steps(here()):
        for room in (copy.steps, copy.stubs):
            (room / step.path).parent.mkdir(parents=True)
            (room / step.path).write_text(stub_for(here(), step), encoding="utf-8")
        shutil.copy(here().steps / step.id / "step.toml", copy.steps / step.id)
    return copy


def written_course(root: Path, *numbers: int) -> Project:
    """The same with these steps written, and the kit's scenes."""
    course = small_project(root)
    for step in (step for step in read_steps(course) if step.index in numbers):
        write_own(course, step, (here().samples / "complete" / "steps" / step.path).read_text(encoding="utf-8"))
    course.scenes.symlink_to(here().scenes)
    return course


def printed() -> Console:
    """A console that keeps what it prints, see `text`."""
    return Console(file=io.StringIO(), width=200, force_terminal=False)


def text(console: Console) -> str:
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


def save(path: Path, text: str) -> None:
    """As editors do: a new file takes the name, so nobody finds half of it."""
    new = path.with_name(f".{path.name}.new")
    new.write_text(text, encoding="utf-8")
    new.replace(path)


def write_own(project: Project, step: Step, source: str) -> Path:
    path = project.steps / step.path
    save(path, source)
    return path


def checked(step: Step, status: str, points: float) -> Results:
    """What a check of one step came to."""
    result = StepResult(step.id, "passed", points, step.points, step.bonus)
    result.status = status  # type: ignore[assignment]
    return Results.of("ann", [result])
