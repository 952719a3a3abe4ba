"""What may be handed in for a step, and what a true grade gives it."""

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from msgspec import Meta

from raysteps.common.documents import Text, parse_table, read_text
from raysteps.common.errors import GraderFault
from raysteps.common.files import write_if_changed
from raysteps.course.manifest import Step, read_step
from raysteps.course.mutants import Mutant, read_alternatives, read_mutants, reference_source, replaced_once
from raysteps.course.project import Project
from raysteps.course.stubs import make_stub, stub_for

Kind = Literal["stub", "reference", "mutant", "alternative", "half"]


@dataclass(frozen=True)
class Band:
    """What a fair instructor gives, in points of the step."""

    low: float
    high: float
    why: str


@dataclass(frozen=True)
class Entrant:
    """One file for one step. A mutant is wrong, a stub is nothing, half-done work has a band, the others are right."""

    kind: Kind
    step: str
    name: str
    source: str
    mutant: Mutant | None = None
    band: Band | None = None

    @property
    def is_right(self) -> bool:
        return self.kind in ("reference", "alternative")


def reference(project: Project, step: Step) -> Entrant:
    """The kit's own solution, as a student would hand it in."""
    return Entrant("reference", step.id, "the reference", reference_source(project, step))


def stub(project: Project, step: Step) -> Entrant:
    """Without the lines that tell that nothing was begun, so that it is run like any other file."""
    lines = stub_for(project, step).splitlines()
    source = "\n".join(line for line in lines if "RAYSTEPS_TODO" not in line) + "\n"
    return Entrant("stub", step.id, "stub", source)


def mutants(project: Project, step: Step) -> list[Entrant]:
    """One for each known mistake."""
    right = reference_source(project, step)
    known = read_mutants(project, step)
    return [Entrant("mutant", step.id, mutant.id, mutant.applied(right), mutant) for mutant in known]


def right_ones(project: Project, step: Step) -> list[Entrant]:
    """The reference, then the other correct ways."""
    return [reference(project, step), *alternatives(project, step)]


def alternatives(project: Project, step: Step) -> list[Entrant]:
    """One for each other correct way."""
    known = read_alternatives(project, step)
    return [Entrant("alternative", step.id, one.name, one.source) for one in known]


# Half-done work: solutions/NN-name/fairness.toml.


@dataclass(frozen=True)
class _Edit:
    """`find` occurs once in the file."""

    find: Text
    replace: str


@dataclass(frozen=True)
class _HalfDone:
    """The reference with functions that are stubs still, or with edits."""

    id: Text
    low: Annotated[float, Meta(ge=0)]
    high: Annotated[float, Meta(gt=0)]
    why: Text
    stubs: tuple[str, ...] = ()
    edits: tuple[_Edit, ...] = ()


@dataclass(frozen=True)
class _Fairness:
    half: Annotated[tuple[_HalfDone, ...], Meta(min_length=1)]


def _half_done(path: Path, step: Step, own: float, solution: str, entry: _HalfDone) -> Entrant:
    """`own`: the step's points by its manifest, of which the band is a part; a course may give others."""
    keep = [name for name in step.functions if name not in entry.stubs]
    if not entry.low < entry.high <= own or len(keep) + len(entry.stubs) != len(step.functions):
        raise GraderFault(f"{path}: {entry.id}: its band or its stubs do not fit the step")
    source = make_stub(solution, step, keep)
    for edit in entry.edits:
        source = replaced_once(source, edit.find, edit.replace, f"{path}: {entry.id}")
    scale = step.points / own
    return Entrant("half", step.id, entry.id, source, band=Band(entry.low * scale, entry.high * scale, entry.why))


def half_done(project: Project, step: Step) -> list[Entrant]:
    """Each with its band; none for a step without the file."""
    path = project.solutions / step.id / "fairness.toml"
    if not path.is_file():
        return []
    table = parse_table(read_text(path), path, "half-done work with its points", _Fairness)
    own = read_step(project.steps / step.id / "step.toml").points
    return [_half_done(path, step, own, read_text(project.solutions / step.path), entry) for entry in table.half]


# The two sample submissions, made from the solutions so that they never drift.


def _with_mistake(source: str, mistake: dict[str, Any]) -> str:
    find = str(mistake["find"])
    return replaced_once(source, find, str(mistake["replace"]), f"grader/samples/partial.toml: '{find}'")


def sample_files(project: Project, steps: list[Step]) -> dict[Path, str]:
    """Path and content of every file of the samples."""
    plan = tomllib.loads((project.samples / "partial.toml").read_text(encoding="utf-8"))
    mistakes = {str(mistake["step"]): mistake for mistake in plan["mistakes"]}
    files: dict[Path, str] = {}
    for step in steps:
        solved = reference_source(project, step)
        files[project.samples / "complete" / "steps" / step.path] = solved
        if step.id in mistakes:
            partial = _with_mistake(solved, mistakes[step.id])
        else:
            partial = solved if step.id in plan["solved"] else stub_for(project, step)
        files[project.samples / "partial" / "steps" / step.path] = partial
    return files


def outdated_samples(project: Project, steps: list[Step]) -> list[Path]:
    """The sample files that differ from what the solutions make."""
    return [
        path
        for path, text in sample_files(project, steps).items()
        if not path.is_file() or path.read_bytes() != text.encode()
    ]


def write_samples(project: Project, steps: list[Step]) -> list[Path]:
    """Writes all samples; returns what changed."""
    return [path for path, text in sample_files(project, steps).items() if write_if_changed(path, text.encode())]
