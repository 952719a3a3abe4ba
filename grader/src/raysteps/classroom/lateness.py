"""How late a submission is, and what that leaves of its points: in numbers, and in words that show the sum."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from decimal import ROUND_CEILING, Decimal

from raysteps.classroom.late_policy import LatePolicy
from raysteps.classroom.names import folded
from raysteps.common.text import count, number

BY_FILE = "by the time of the file"
_DAY = timedelta(days=1)


@dataclass(frozen=True)
class Lateness:
    """`points` is what is left; the points of the results stay as they are."""

    days: int
    percent: float
    points: float
    deadline: str
    words: str


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
