"""What a course settles once for a term, so that nobody has to remember it: course.toml."""

import os
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from raysteps.common.documents import Malformed, Text, convert
from raysteps.common.errors import UsageError, reason
from raysteps.course.project import Project

FILE = "course.toml"
PLACE = "RAYSTEPS_COURSE"  # names another file: a seed that is secret need not lie in a repository
USUAL_SEED = 1


@dataclass(frozen=True)
class Course:
    """Each is None where the course does not say it."""

    path: Path | None = None
    seed: int | None = None
    late_policy: Path | None = None

    def seed_or(self, wanted: int | None) -> int:
        """The seed that was asked for, else the course's, else the kit's."""
        if wanted is not None:
            return wanted
        return USUAL_SEED if self.seed is None else self.seed


@dataclass(frozen=True)
class _Table:
    """What may stand in course.toml; the late policy is a TOML file, seen from the folder of course.toml."""

    seed: Annotated[int, Meta(ge=0, le=999_999_999_999_999_999)] | None = None
    late_policy: Text | None = None


def _path(project: Project) -> Path | None:
    named = os.environ.get(PLACE, "")
    if named:
        path = Path(named)
        if not path.is_file():
            raise UsageError(f"{PLACE}={named}: is not there; expected a {FILE}, or unset the variable")
        return path
    path = project.root / FILE
    return path if path.is_file() else None


def read_course(project: Project) -> Course:
    """The course of this kit; one that settles nothing where there is no file."""
    path = _path(project)
    if path is None:
        return Course()
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: cannot be read as TOML: {reason(error)}") from error
    try:
        told = convert(table, _Table)
    except Malformed as error:
        expected = 'expected `seed = N` and `late_policy = "FILE"`, or one of them'
        raise UsageError(f"{path}: {error}; {expected}") from error
    return Course(path, told.seed, None if told.late_policy is None else path.parent / told.late_policy)
