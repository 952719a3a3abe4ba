"""Finds the row of a gradebook that belongs to a submission."""

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from raysteps.common.errors import UsageError
from raysteps.common.text import listed
from raysteps.exports.class_results import Graded

_NUMBER_AT_END = re.compile(r"[0-9]+$")


@dataclass(frozen=True)
class Person:
    """Who a row of the gradebook is about. `ids` and `emails` tell people apart; names do so only if they must."""

    label: str
    ids: frozenset[str]
    emails: frozenset[str]
    name: str


def folded(text: str) -> str:
    """For comparisons: without differences of case, spacing and encoding."""
    return " ".join(unicodedata.normalize("NFKC", text).casefold().split())


def spoken_name(text: str) -> str:
    """`Lee, Ann` and `Ann Lee` are one name."""
    last, comma, first = text.partition(",")
    return folded(f"{first} {last}" if comma and "," not in first else text)


def number_at_end(text: str) -> str:
    """`Participant 123` is 123, in whatever language Moodle wrote it."""
    found = _NUMBER_AT_END.search(text)
    return found.group() if found else ""


def _same_id(graded: Graded, person: Person) -> bool:
    return any(folded(one) in person.ids for one in graded.ids)


def _same_email(graded: Graded, person: Person) -> bool:
    return bool(graded.email) and folded(graded.email) in person.emails


def _same_name(graded: Graded, person: Person) -> bool:
    return bool(graded.name) and spoken_name(graded.name) == person.name


def _candidates(graded: Graded, people: Sequence[Person]) -> list[int]:
    sure = [at for at, one in enumerate(people) if _same_id(graded, one) or _same_email(graded, one)]
    return sure or [at for at, one in enumerate(people) if _same_name(graded, one)]


def match(graded: Sequence[Graded], people: Sequence[Person]) -> Mapping[int, int]:
    """From submissions to rows; one that fits no row is left out. Whatever fits twice is an error."""
    found: dict[int, int] = {}
    taken: dict[int, int] = {}
    for at, one in enumerate(graded):
        rows = _candidates(one, people)
        if len(rows) > 1:
            which = listed([people[row].label for row in rows])
            raise UsageError(f"{one.label} fits more than one row: {which}; make their identities differ")
        if not rows:
            continue
        if rows[0] in taken:
            both = listed([graded[taken[rows[0]]].label, one.label])
            raise UsageError(f"{both} both fit {people[rows[0]].label}; remove one of them from results.csv")
        found[at] = rows[0]
        taken[rows[0]] = at
    return found
