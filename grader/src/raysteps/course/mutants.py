"""The known mistakes of a step: solutions/NN-name/mutants.toml."""

from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from raysteps.common.documents import Text, parse_table, place_in_toml, read_text
from raysteps.common.errors import GraderFault
from raysteps.common.text import did_you_mean
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import without_markers


def replaced_once(source: str, find: str, new: str, where: str) -> str:
    """The source with one change; what is to be changed must stand there once."""
    times = source.count(find)
    if times != 1:
        raise GraderFault(
            f"{where}: `find` occurs {times} times in the reference, expected once; "
            f"{'take more of what stands around it' if times else 'copy it anew from there'}"
        )
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
    entry: tuple[Path, int] | None = field(default=None, compare=False, repr=False)  # its file, and which entry of it

    def choices(self) -> dict[str, "Mutant"]:
        """All forms of the mistake, the one of the catalogue first, each with a name of its own."""
        changes = [(self.find, self.replace), *self.others]
        forms = [replace(self, find=find, replace=other, others=()) for find, other in changes]
        return {f"{self.id}~{number}" if number else self.id: form for number, form in enumerate(forms)}

    def applied(self, reference: str) -> str:
        """The reference's source with the mistake in it."""
        try:
            return replaced_once(reference, self.find, self.replace, self.id)
        except GraderFault as error:
            place = f"{self.step}/mutants.toml" if self.entry is None else _place(*self.entry)
            raise GraderFault(f"{place}: {error}") from error


def _place(path: Path, at: int) -> str:
    """FILE:LINE:COLUMN of an entry."""
    return f"{path}:{place_in_toml(read_text(path), ['mutants', str(at)])}"


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


_EXPECTED = {
    "id": 'a name of small letters, digits and hyphens, such as "normal-not-turned"',
    **dict.fromkeys(("name", "sees", "cause", "hint"), "a sentence"),
}


def _mutant(step: Step, entry: _Entry, path: Path, at: int) -> Mutant:
    if entry.function not in step.functions:
        meant = did_you_mean(entry.function, step.functions) or f"; expected one of {', '.join(step.functions)}"
        raise GraderFault(f"{_place(path, at)}: {entry.id}: {entry.function} is no function of the step{meant}")
    name, sees, cause, hint = (" ".join(text.split()) for text in (entry.name, entry.sees, entry.cause, entry.hint))
    return Mutant(
        id=entry.id,
        step=step.id,
        function=entry.function,
        name=name,
        sees=sees,
        cause=cause,
        hint=hint,
        find=entry.find,
        replace=entry.replace,
        others=tuple((other.find, other.replace) for other in entry.others),
        entry=(path, at),
    )


@lru_cache(maxsize=64)
def _parse(text: str, step: Step, path: Path) -> tuple[Mutant, ...]:
    catalogue = parse_table(text, path, "a catalogue of mistakes", _Catalogue, _EXPECTED)
    mutants = tuple(_mutant(step, entry, path, at) for at, entry in enumerate(catalogue.mutants))
    names = [mutant.id for mutant in mutants]
    for at, name in enumerate(names):
        if name in names[:at]:
            raise GraderFault(f"{_place(path, at)}: the id {name} occurs twice; expected another one")
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
