"""The late policy: reading it, and what it takes."""

from collections.abc import Sequence
from datetime import timedelta

import pytest

import raysteps.classroom.late_policy
from raysteps.classroom.late_policy import LatePolicy, apply_policy, parse_late_policy, with_zone
from raysteps.common.documents import place_in_toml
from raysteps.common.errors import UsageError

pytestmark = pytest.mark.portable

_POLICY = """
deadline = 2026-11-20T23:59:00+01:00
grace_minutes = 10
percent_per_day = 10
max_days = 5

[extensions]
S2 = 2026-11-23T23:59:00+01:00
"s 3" = 1
"""


def _policy() -> LatePolicy:
    return parse_late_policy(_POLICY, "late.toml")


def test_reading() -> None:
    policy = _policy()
    assert policy.grace == timedelta(minutes=10)
    assert policy.extensions["s2"] - policy.deadline == timedelta(days=3)
    assert policy.extensions["s 3"] - policy.deadline == timedelta(days=1)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("deadline = \n", r"^late\.toml:1:12: is not TOML: invalid value"),
        ("percent_per_day = 5\n", r"^late\.toml:1:1: expected the key `deadline`"),
        ("# due\ndeadline = 2026-11-20T23:59:00\npercent_per_day = 5", r"^late\.toml:2:1: `deadline`: .* time zone"),
        ("deadline = 2026-11-20\npercent_per_day = 5", r"^late\.toml:1:1: `deadline`: .* time zone"),
        ('deadline = "2026-13-20T23:59:00Z"\npercent_per_day = 5', r"^late\.toml:1:1: 2026-13-20.* no date"),
        (_POLICY.replace("= 10\nmax", "= 101\nmax"), r"^late\.toml:4:1: `percent_per_day`: .*from 0 to 100, found 101"),
        (_POLICY.replace("grace_minutes = 10", "grace_minutes = nan"), r"^late\.toml:3:1: `grace_minutes`"),
        (_POLICY.replace("max_days = 5", "max_days = 1.5"), r"^late\.toml:5:1: `max_days`: expected a whole number"),
        (_POLICY.replace("max_days = 5", "max_dais = 5"), r"^late\.toml:5:1: `max_dais` is no key .* max_days"),
        (_POLICY.replace("max_days = 5", "max_days = true"), r"^late\.toml:5:1: `max_days`"),
        (_POLICY.replace('"s 3" = 1', '"s 3" = 2026-12-01'), r"^late\.toml:9:1: `extensions\.s 3`: expected a number"),
        (_POLICY.replace('"s 3" = 1', '"s 3" = -1'), r"^late\.toml:9:1: `extensions\.s 3`"),
        (_POLICY.replace('"s 3" = 1', "s2 = 1"), r"^late\.toml:9:1: `extensions\.s2` stands there twice"),
        (_POLICY.replace("2026-11-23T", "2026-11-03T"), r"^late\.toml:8:1: `extensions\.S2` ends before"),
        ("extensions = 3\n" + _POLICY.split("[")[0], r"^late\.toml:1:1: `extensions`: expected a table"),
    ],
)
def test_messages_name_line_and_key(text: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        parse_late_policy(text, "late.toml")


@pytest.mark.parametrize(
    ("submitted", "days", "points", "words"),
    [
        ("2026-11-20T22:00:00+00:00", 0, 85.0, "on time"),
        ("2026-11-20T23:59:00+01:00", 0, 85.0, "on time"),
        ("2026-11-21T00:09:00+01:00", 0, 85.0, "10 minutes of grace"),
        ("2026-11-21T00:09:01+01:00", 1, 76.5, "takes 10 % off 85 points: 85 - 8.5 = 76.5 points"),
        ("2026-11-21T23:59:00+01:00", 1, 76.5, "1 day after"),
        ("2026-11-21T22:59:01+00:00", 2, 68.0, "2 days begun"),
        ("2026-11-25T23:59:00+01:00", 5, 42.5, "5 days begun"),
        ("2026-11-26T00:00:00+01:00", 6, 0.0, "more than 5 days: 0 points"),
        ("2026-11-21T00:30:00", 1, 76.5, "31 minutes after"),  # in the zone of the deadline
        ("", 0, 85.0, "not known"),
    ],
)
def test_arithmetic(submitted: str, days: int, points: float, words: str) -> None:
    late = apply_policy(_policy(), ["s1"], submitted, 85.0)
    assert (late.days, late.points) == (days, points)
    assert words in late.words


def test_no_place_is_looked_for_where_nothing_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each takes a look through the whole text: one for each extension would make it quadratic."""
    looked: list[Sequence[str]] = []

    def place(text: str, path: Sequence[str]) -> str:
        looked.append(path)
        return place_in_toml(text, path)

    monkeypatch.setattr(raysteps.classroom.late_policy, "place_in_toml", place)
    text = _POLICY + "".join(f"more{number} = 3\n" for number in range(20))
    assert len(parse_late_policy(text, "late.toml").extensions) > 20
    assert looked == []
    with pytest.raises(UsageError, match=r"^late\.toml:29:1: `extensions.more19` ends before"):
        parse_late_policy(text.replace("more19 = 3", "more19 = 2020-01-01T00:00:00Z"), "late.toml")


def test_extensions_move_the_deadline() -> None:
    late = apply_policy(_policy(), ["s2"], "2026-11-23T23:59:00+01:00", 50.0)
    assert (late.days, late.points) == (0, 50.0)
    assert "extension" in late.words
    late = apply_policy(_policy(), ["s1", "S 3"], "2026-11-22T12:00:00+01:00", 50.0)  # two students, one submission
    assert (late.days, late.points, late.deadline) == (1, 45.0, "2026-11-21 23:59+01:00")


def test_never_below_nothing() -> None:
    policy = parse_late_policy("deadline = 2026-11-20T23:59:00Z\npercent_per_day = 40", "late.toml")
    late = apply_policy(policy, [], "2026-12-20T23:59:00Z", 50.0)
    assert (late.percent, late.points) == (100.0, 0.0)


def test_a_time_without_a_zone_is_in_that_of_the_deadline_that_counts() -> None:
    text = "deadline = 2026-11-20T23:59:00+01:00\npercent_per_day = 10\n[extensions]\ns2 = 2026-11-22T23:59:00-05:00\n"
    policy = parse_late_policy(text, "late.toml")
    assert apply_policy(policy, ["s2"], "2026-11-22T23:30:00", 50.0).days == 0
    assert apply_policy(policy, ["s2"], "2026-11-23T00:30:00", 50.0).days == 1
    assert apply_policy(policy, ["s1"], "2026-11-20T23:30:00", 50.0).days == 0


@pytest.mark.parametrize(
    ("percent", "points", "left", "words"),
    [
        ("33.3", 10.01, 6.68, "33.3 % each, takes 33.3 % off 10.01 points: 10.01 - 3.33 = 6.68"),  # 6.67667
        ("10", 0.05, 0.05, "0.05 - 0 = 0.05"),  # 0.045
        ("0.125", 80.0, 79.9, "0.125 % each, takes 0.125 % off"),
        ("10", 8.7, 7.83, "8.7 - 0.87 = 7.83"),  # exactly
        ("0", 8.7, 8.7, "8.7 - 0 = 8.7"),
    ],
)
def test_sums_are_as_on_paper(percent: str, points: float, left: float, words: str) -> None:
    policy = parse_late_policy(f"deadline = 2026-11-20T23:59:00Z\npercent_per_day = {percent}", "late.toml")
    late = apply_policy(policy, [], "2026-11-21T10:00:00Z", points)
    assert late.points == left
    assert words in late.words


def test_days_are_counted_in_whole_numbers() -> None:
    policy = parse_late_policy("deadline = 2026-11-20T23:59:00Z\npercent_per_day = 1\nmax_days = 5.0", "late.toml")
    assert "more than 5 days: 0 points" in apply_policy(policy, [], "2026-12-20T23:59:00Z", 50.0).words


def test_it_is_said_that_only_a_file_tells_the_time() -> None:
    late = apply_policy(_policy(), ["s1"], "2026-11-21T10:00:00Z", 85.0, by_file=True)
    assert "the deadline (2026-11-20 23:59+01:00), by the time of the file: 1 day begun" in late.words
    assert "by the time of the file" not in apply_policy(_policy(), ["s1"], "2026-11-21T10:00:00Z", 85.0).words
    assert "by the time of the file" in apply_policy(_policy(), [], "2026-11-20T10:00:00Z", 85.0, by_file=True).words


def test_a_zone_for_every_time() -> None:
    assert with_zone(_policy(), [], "2026-11-20T10:00:00") == "2026-11-20T10:00:00+01:00"
    assert with_zone(_policy(), [], "2026-11-20T10:00:00-05:00") == "2026-11-20T10:00:00-05:00"
    assert with_zone(None, [], "2026-11-20T10:00:00") == "2026-11-20T10:00:00+00:00"
    assert with_zone(None, [], "") == ""
