"""What the last run was given beside the submissions: a --resume that does not name it anew uses it again."""

import json
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

from raysteps.classroom.database import FILE, ClassDatabase
from raysteps.classroom.late_policy import parse_late_policy
from raysteps.classroom.order import Order
from raysteps.classroom.places import read_text
from raysteps.classroom.roster import Student, read_roster
from raysteps.common.errors import UsageError
from raysteps.common.text import count

_NOBODY = Student(0, "", "", "")


@dataclass
class Given:
    """`files` are no submissions, wherever they lie; `said` tells what comes from the last run."""

    students: list[Student] = field(default_factory=list)
    late_policy: str = ""  # the text of the file
    files: list[Path] = field(default_factory=list)
    said: list[str] = field(default_factory=list)


def roster_text(students: Sequence[Student]) -> str:
    """As the database keeps it."""
    return json.dumps([vars(student) for student in students], ensure_ascii=False)


@dataclass
class _Last(Given):
    is_lost: bool = False  # a version of the kit that did not keep everything wrote the database


def _last(out: Path) -> _Last:
    """What the database knows; nothing where no run has begun yet."""
    if not (out / FILE).is_file():
        return _Last()
    with closing(ClassDatabase(out)) as database:
        run = database.connection.execute(
            "SELECT late_policy, given.roster, given.files, EXISTS (SELECT 1 FROM students) AS had_roster "
            "FROM runs LEFT JOIN given USING (uid) ORDER BY number DESC LIMIT 1"
        ).fetchone()
    if run is None:
        return _Last()
    if run["roster"] is None:
        return _Last([_NOBODY] if run["had_roster"] else [], run["late_policy"], is_lost=True)
    students = [Student(**row) for row in json.loads(run["roster"])]
    return _Last(students, run["late_policy"], [Path(path) for path in json.loads(run["files"])])


def _used_again(last: _Last, out: Path, option: str, what: str) -> str:
    """The line that says so."""
    if last.is_lost:
        raise UsageError(
            f"--resume: the last run in {out} had a {option[2:].replace('-', ' ')}, but an earlier version of the kit "
            f"did not keep all of it; give it again with {option} FILE, or drop it with {option} none"
        )
    return f"{what} of the last run in {out} is used again; {option} FILE takes another one, {option} none drops it"


def read_given(order: Order) -> Given:
    """The roster and the late policy that were named, else with --resume those of the last run."""
    last = _last(order.out) if order.resume else _Last()
    given = Given(files=[path for path in (order.roster, order.late_policy) if path is not None] + last.files)
    if order.late_policy is not None:
        given.late_policy = read_text(order.late_policy)
        parse_late_policy(given.late_policy, str(order.late_policy))
    elif last.late_policy and not order.no_late_policy:
        given.late_policy = last.late_policy
        given.said.append(_used_again(last, order.out, "--late-policy", "the late policy"))
    if order.roster is not None:
        given.students = read_roster(order.roster)
    elif last.students and not order.no_roster:
        given.students = last.students
        what = f"the roster ({count(len(last.students), 'student')})"
        given.said.append(_used_again(last, order.out, "--roster", what))
    return given
