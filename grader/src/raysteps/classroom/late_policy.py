"""The late policy: a TOML file with the deadline, and what lateness costs."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, date, datetime, time, timedelta
from decimal import ROUND_CEILING, Decimal
from typing import Annotated, NoReturn

from msgspec import Meta

from raysteps.classroom.entries import folded
from raysteps.common.documents import Malformed, convert, place_in_toml, read_toml
from raysteps.common.errors import UsageError
from raysteps.common.text import count, number
from raysteps.results.model import Lateness


@dataclass(frozen=True)
class LatePolicy:
    """When work is due, and how much each day that has begun after that takes from its points."""

    deadline: datetime
    percent_per_day: float
    grace: timedelta = timedelta()
    max_days: int | None = None  # what is later than that gets nothing
    extensions: Mapping[str, datetime] = field(default_factory=dict)  # by folded student id


# What the file may say; dates and times are words here.

_MOMENT = r"^2[0-9]{3}-[0-9]{2}-[0-9]{2}[T ][0-9]{2}:[0-9]{2}(:[0-9]{2}(\.[0-9]+)?)?(Z|[+-][0-9]{2}:[0-9]{2})$"
Moment = Annotated[str, Meta(pattern=_MOMENT)]


@dataclass(frozen=True)
class _File:
    deadline: Moment
    percent_per_day: Annotated[float, Meta(ge=0, le=100)]
    grace_minutes: Annotated[float, Meta(ge=0, le=100000)] = 0
    max_days: Annotated[int, Meta(ge=0, le=10000)] | None = None
    extensions: dict[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class _Extension:
    end: Moment | Annotated[float, Meta(ge=0, le=10000)]


_EXPECTED = {
    "deadline": "a date and time with a time zone, such as 2026-11-20T23:59:00+01:00",
    "grace_minutes": "a number from 0 to 100000",
    "percent_per_day": "a number from 0 to 100",
    "max_days": "a whole number from 0 to 10000",
    "extensions": "a table of student ids, each with a new deadline or a number of days",
}
_EXTENSION = "a number of days from 0 to 10000, or a date and time with a time zone, such as 2026-11-23T23:59:00+01:00"


def _plain(value: object) -> object:
    """As JSON would hold it, 5.0 as 5; `nan` and `inf` become words, because they are numbers of no use here."""
    if isinstance(value, dict):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [_plain(inner) for inner in value]
    if isinstance(value, float):
        return str(value) if not math.isfinite(value) else int(value) if value.is_integer() else value
    return value.isoformat() if isinstance(value, (datetime, date, time)) else value


def _place(text: str, name: str, within: Sequence[str], path: Sequence[str]) -> str:
    return f"{name}:{place_in_toml(text, [*within, *path])}"


def _read(text: str, name: str, within: Sequence[str]) -> tuple[_File, dict[str, str | float]]:
    """What the file says, and its extensions."""

    def refuse(path: list[str], words: str) -> UsageError:
        return UsageError(f"{_place(text, name, within, path)}: {words}")

    def wrong(path: list[str], expected: str, found: object) -> UsageError:
        return refuse(path, f"`{'.'.join(path)}`: expected {expected}, found {json.dumps(found)}")

    whole = read_toml(text, name)
    for key in within:
        whole = whole[key]
    table = {key: _plain(value) for key, value in whole.items()}
    for key in table:
        if key not in _EXPECTED:
            raise refuse([key], f"`{key}` is no key of a late policy; they are {', '.join(_EXPECTED)}")
    for key in ("deadline", "percent_per_day"):
        if key not in table:
            raise refuse([], f"expected the key `{key}`, {_EXPECTED[key]}")
    try:
        file = convert(table, _File)
    except Malformed as error:
        key = str(error).partition(":")[0].removeprefix("$.")
        raise wrong([key], _EXPECTED[key], table[key]) from error
    ends = {}
    for student, end in file.extensions.items():
        try:
            ends[student] = convert({"end": end}, _Extension).end
        except Malformed as error:
            raise wrong(["extensions", student], _EXTENSION, end) from error
    return file, ends


def parse_late_policy(text: str, name: str, within: Sequence[str] = ()) -> LatePolicy:
    """Reads the text of a late policy, or of a file that has one as its table `within`; `name` stands in messages."""
    file, ends = _read(text, name, within)

    def refuse(words: str, *path: str) -> NoReturn:  # to work out the place, the whole text is looked through
        raise UsageError(f"{_place(text, name, within, path)}: {words}")

    def moment(value: str, *path: str) -> datetime:
        try:
            return datetime.fromisoformat(value)
        except ValueError as error:
            refuse(f"{value} is no date and time: {error}", *path)

    deadline = moment(file.deadline, "deadline")
    extensions: dict[str, datetime] = {}
    for student, value in ends.items():
        own = ("extensions", student)
        extended = moment(value, *own) if isinstance(value, str) else deadline + timedelta(days=value)
        if extended < deadline:
            refuse(f"`extensions.{student}` ends before the deadline", *own)
        if extensions.setdefault(folded(student), extended) is not extended:
            refuse(f"`extensions.{student}` stands there twice, in upper and lower case", *own)
    grace = timedelta(minutes=file.grace_minutes)
    return LatePolicy(deadline, file.percent_per_day, grace, file.max_days, extensions)


def _as_toml(value: object) -> str:
    return value.isoformat() if isinstance(value, datetime) else json.dumps(value, ensure_ascii=False)


def late_policy_text(table: Mapping[str, object]) -> str:
    """A table of course.toml as a file of its own."""
    lines = [f"{key} = {_as_toml(value)}" for key, value in table.items() if not isinstance(value, dict)]
    for key, inner in table.items():
        if isinstance(inner, dict):
            lines += ["", f"[{key}]", *(f"{json.dumps(name)} = {_as_toml(value)}" for name, value in inner.items())]
    return "\n".join(lines) + "\n"


# How late a submission is, and what that leaves of its points: in numbers, and in words that show the sum.

BY_FILE = "by the time of the file"
_DAY = timedelta(days=1)


def _span(span: timedelta) -> str:
    minutes = int(span.total_seconds() // 60)
    parts = [(minutes // 1440, "day"), (minutes // 60 % 24, "hour"), (minutes % 60, "minute")]
    return " ".join(count(amount, unit) for amount, unit in parts if amount) or "less than a minute"


def _deadline(policy: LatePolicy, students: Sequence[str]) -> datetime:
    """Of several students with one submission the latest deadline counts."""
    extended = [policy.extensions[folded(student)] for student in students if folded(student) in policy.extensions]
    return max([policy.deadline, *extended])


def _left(points: float, percent: Decimal) -> float:
    """In decimal numbers, as anybody would check the sum; hundredths are rounded in the student's favour."""
    exact = Decimal(str(points)) * (100 - percent) / 100
    return float(exact.quantize(Decimal("0.01"), rounding=ROUND_CEILING))


def with_zone(policy: LatePolicy | None, students: Sequence[str], submitted_at: str) -> str:
    """A time without a zone is in that of the deadline that counts for these students, else in UTC."""
    if not submitted_at:
        return ""
    moment = datetime.fromisoformat(submitted_at)
    zone = _deadline(policy, students).tzinfo if policy is not None else UTC
    return (moment if moment.tzinfo is not None else moment.replace(tzinfo=zone)).isoformat()


def apply_policy(
    policy: LatePolicy, students: Sequence[str], submitted_at: str, points: float, *, by_file: bool = False
) -> Lateness:
    """`students` are the ids whose extensions count. `by_file`: nobody but the time of a file says when it was."""
    deadline = _deadline(policy, students)
    extension = ", with an extension" if deadline != policy.deadline else ""
    shown = deadline.isoformat(sep=" ", timespec="minutes")
    if not submitted_at:
        words = f"It is not known when this was handed in, so nothing is taken off: {number(points)} points."
        return Lateness(0, 0.0, points, shown, words)
    source = f", {BY_FILE}" if by_file else ""
    late = datetime.fromisoformat(with_zone(policy, students, submitted_at)) - deadline
    if late <= timedelta():
        return Lateness(0, 0.0, points, shown, f"Handed in on time{extension}{source}: {number(points)} points.")
    after = f"Handed in {_span(late)} after the deadline ({shown}{extension}){source}"
    if late <= policy.grace:
        words = f"{after}, within {_span(policy.grace)} of grace: {number(points)} points."
        return Lateness(0, 0.0, points, shown, words)
    days = -(-late // _DAY)
    if policy.max_days is not None and days > policy.max_days:
        return Lateness(days, 100.0, 0.0, shown, f"{after}, more than {count(policy.max_days, 'day')}: 0 points.")
    percent = min(Decimal(100), days * Decimal(str(policy.percent_per_day)))
    left = _left(points, percent)
    words = (
        f"{after}: {count(days, 'day')} begun, {policy.percent_per_day:g} % each, takes {float(percent):g} % off "
        f"{number(points)} points: {number(points)} - {number(round(points - left, 2))} = {number(left)} points."
    )
    return Lateness(days, float(percent), left, shown, words)
