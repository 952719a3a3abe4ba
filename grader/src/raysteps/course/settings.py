"""What a course settles once for a term, so that nobody has to remember it: course.toml."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date, datetime, time
from functools import lru_cache
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from raysteps.common.documents import Malformed, Text, convert, place_in_toml, read_toml
from raysteps.common.errors import UsageError, reason
from raysteps.common.text import MAX_FOUND, belongs_above, clean, did_you_mean
from raysteps.course.project import Project

FILE = "course.toml"
COURSE_VARIABLE = "RAYSTEPS_COURSE"  # names another file: a seed that is secret need not lie in a repository
USUAL_SEED = 1


@dataclass(frozen=True)
class Course:
    """Each is empty where the course does not say it."""

    path: Path | None = None
    seed: int | None = None
    late_policy: Path | None = None  # a file, or the table
    late_table: Mapping[str, object] = field(default_factory=dict)
    title: str = ""
    term: str = ""
    parts: tuple[int, ...] = (1,)  # which courses of the kit
    steps: tuple[str, ...] = ()  # as a command line names them
    dates: Mapping[str, date] = field(default_factory=dict)  # by such names: when they are given out
    points: Mapping[str, float] = field(default_factory=dict)  # by such names: what each is worth
    text: str = field(default="", compare=False, repr=False)

    @property
    def name(self) -> str:
        """`Graphics 101, autumn 2026`."""
        return ", ".join(filter(None, (self.title, self.term)))

    def seed_or(self, wanted: int | None) -> int:
        """The seed that was asked for, else the course's, else the kit's."""
        if wanted is not None:
            return wanted
        return USUAL_SEED if self.seed is None else self.seed

    def place(self, *keys: str) -> str:
        """`course.toml:3:1` of a key."""
        return f"{self.path or FILE}:{place_in_toml(self.text, keys)}"


_Line = Annotated[str, Meta(min_length=1, max_length=200, pattern=r"^\S[^\n\r]*$")]
_MAX_POINTS = 10_000
_Names = _Line | Annotated[int, Meta(ge=0, le=99)]


@dataclass(frozen=True)
class _Table:
    """What may stand in course.toml; the late policy is a table, or a TOML file seen from the folder of course.toml."""

    title: _Line = ""
    term: _Line = ""
    parts: Annotated[list[Annotated[int, Meta(ge=1, le=9)]], Meta(min_length=1)] = field(default_factory=lambda: [1])
    steps: _Names | list[_Names] | dict[str, date] | None = None
    points: dict[str, Annotated[float, Meta(gt=0, le=_MAX_POINTS)]] = field(default_factory=dict)
    seed: Annotated[int, Meta(ge=0, le=999_999_999_999_999_999)] | None = None
    late_policy: Text | dict[str, object] | None = None


_EXPECTED = {
    "title": "the name of the course, in one line",
    "term": "the name of the term, in one line",
    "parts": "a list of the kit's parts, such as [1, 2]",
    "steps": 'steps such as "1-4", a list of them, or a table with the day on which they are given out, such as '
    '"1-2" = 2026-10-12',
    "points": f'a table of steps, each with its points (more than 0, at most {_MAX_POINTS}), such as "02" = 25',
    "seed": "a whole number from 0 to 999999999999999999",
    "late_policy": "the name of a file, or a table with its deadline and percent_per_day",
}


def _path(project: Project) -> Path | None:
    named = os.environ.get(COURSE_VARIABLE, "")
    if named:
        path = Path(named)
        if not path.is_file():
            raise UsageError(f"{COURSE_VARIABLE}={named}: is not there; expected a {FILE}, or unset the variable")
        return path
    path = project.root / FILE
    return path if path.is_file() else None


def _refuse_wrong(key: str, value: object, name: str | None, text: str, path: Path) -> None:
    """`name`: of an entry in the table of that key."""
    try:
        if key == "steps" and isinstance(value, datetime):  # a date, too, but a day has no time
            raise Malformed("")
        convert({key: value if name is None else {name: value}}, _Table)
    except Malformed as error:
        where = place_in_toml(text, [key] if name is None else [key, name])
        found = clean(str(value) if isinstance(value, (date, time)) else repr(value), MAX_FOUND)
        raise UsageError(f"{path}:{where}: {key}: expected {_EXPECTED[key]}; found {found}") from error


def _refuse_wrong_keys(table: Mapping[str, object], text: str, path: Path) -> None:
    for key, value in table.items():
        if key not in _EXPECTED:
            where = place_in_toml(text, [key])
            advice = did_you_mean(key, _EXPECTED) or f"; known are {', '.join(_EXPECTED)}"
            raise UsageError(f"{path}:{where}: unknown key '{clean(key)}'{advice}")
        if key in ("steps", "points") and isinstance(value, dict):
            for name, inner in value.items():
                if name in _EXPECTED:
                    where = place_in_toml(text, [key, name])
                    raise UsageError(f"{path}:{where}: {key}: {belongs_above(name)}")
                _refuse_wrong(key, inner, name, text, path)
        else:
            _refuse_wrong(key, value, None, text, path)


@lru_cache(maxsize=8)
def _parse(text: str, path: Path) -> Course:
    table = read_toml(text, str(path))
    _refuse_wrong_keys(table, text, path)
    told = convert(table, _Table)
    steps = [] if told.steps is None else told.steps
    dates = steps if isinstance(steps, dict) else {}
    names = tuple(map(str, steps if isinstance(steps, (list, dict)) else [steps]))
    late = told.late_policy
    file = path.parent / late if isinstance(late, str) else None
    rules = late if isinstance(late, dict) else {}
    parts = tuple(sorted(set(told.parts)))
    return Course(path, told.seed, file, rules, told.title, told.term, parts, names, dates, told.points, text)


def read_course(project: Project) -> Course:
    """The course of this kit; one that settles nothing where there is no file."""
    path = _path(project)
    if path is None:
        return Course()
    try:
        return _parse(path.read_text(encoding="utf-8-sig"), path)
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: cannot be read: {reason(error)}") from error
