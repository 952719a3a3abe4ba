"""The known mistakes of a step: solutions/NN-name/mutants.toml."""

from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from raysteps.common.documents import Text, parse_table, read_text
from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import without_markers


def replaced_once(source: str, find: str, new: str, where: str) -> str:
    """The source with one change; what is to be changed must stand there once."""
    times = source.count(find)
    if times != 1:
        raise GraderFault(f"{where}: `find` occurs {times} times, expected once")
    return source.replace(find, new)


@dataclass(frozen=True)
class Mutant:
    """One mistake that students make, as a small change of the reference.

    `name` ends the sentence "this is what you get when ..."; `hint` helps without giving the line away. `others`: the
    same mistake at another place or with another number, so that it is known there too.
    """

    id: str
    step: str
    function: str
    name: str
    sees: str
    cause: str
    hint: str
    find: str
    replace: str
    others: tuple[tuple[str, str], ...] = ()

    def choices(self) -> dict[str, "Mutant"]:
        """All forms of the mistake, the one of the catalogue first, each with a name of its own."""
        changes = [(self.find, self.replace), *self.others]
        forms = [replace(self, find=find, replace=other, others=()) for find, other in changes]
        return {f"{self.id}~{number}" if number else self.id: form for number, form in enumerate(forms)}

    def applied(self, reference: str) -> str:
        """The reference's source with the mistake in it."""
        return replaced_once(reference, self.find, self.replace, f"{self.step}/mutants.toml: {self.id}")


def reference_source(project: Project, step: Step) -> str:
    """The reference's file without the marks of the stub's regions."""
    return without_markers((project.solutions / step.path).read_text(encoding="utf-8"))


_Sentence = Annotated[str, Meta(min_length=5)]


@dataclass(frozen=True)
class _Change:
    """`find` occurs once in the reference."""

    find: Text
    replace: str


@dataclass(frozen=True)
class _Entry:
    """A mistake as the file has it."""

    id: Annotated[str, Meta(pattern="^[a-z0-9]+(-[a-z0-9]+)*$")]
    function: Text
    name: _Sentence
    sees: _Sentence
    cause: _Sentence
    hint: _Sentence
    find: Text
    replace: str
    others: tuple[_Change, ...] = ()


@dataclass(frozen=True)
class _Catalogue:
    mutants: Annotated[tuple[_Entry, ...], Meta(min_length=1)]


def _mutant(step: Step, entry: _Entry) -> Mutant:
    if entry.function not in step.functions:
        raise GraderFault(f"{step.id}/mutants.toml: {entry.id}: {entry.function} is no function of the step")
    name, sees, cause, hint = (" ".join(text.split()) for text in (entry.name, entry.sees, entry.cause, entry.hint))
    others = tuple((other.find, other.replace) for other in entry.others)
    return Mutant(entry.id, step.id, entry.function, name, sees, cause, hint, entry.find, entry.replace, others)


@lru_cache(maxsize=64)
def _parse(text: str, step: Step, path: Path) -> tuple[Mutant, ...]:
    catalogue = parse_table(text, path, "a catalogue of mistakes", _Catalogue)
    mutants = tuple(_mutant(step, entry) for entry in catalogue.mutants)
    names = [mutant.id for mutant in mutants]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise GraderFault(f"{path}: the id {twice} occurs twice")
    return mutants


def read_mutants(project: Project, step: Step) -> tuple[Mutant, ...]:
    """In the file's order; none in a student's kit, which has no solutions."""
    path = project.solutions / step.id / "mutants.toml"
    if not path.is_file():
        return ()
    return _parse(read_text(path), step, path)


# Other correct ways to write a step: solutions/NN-name/alternatives/*.cpp.


@dataclass(frozen=True)
class Alternative:
    """A correct file of a step that differs from the reference in method or arithmetic."""

    name: str
    step: str
    source: str


def read_alternatives(project: Project, step: Step) -> tuple[Alternative, ...]:
    """Sorted by name; none in a student's kit, which has no solutions."""
    found = []
    for path in sorted((project.solutions / step.id / "alternatives").glob("*.cpp")):
        found.append(Alternative(path.stem, step.id, read_text(path)))
    return tuple(found)
