"""Finds the row of a gradebook that belongs to a submission."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from raysteps.classroom.names import folded
from raysteps.common.errors import UsageError
from raysteps.common.text import listed
from raysteps.exports.class_results import Graded

_NUMBER_AT_END = re.compile(r"[0-9]+$")


@dataclass(frozen=True)
class Person:
    """Who a row of the gradebook is about, from the best evidence to the least."""

    label: str
    emails: frozenset[str]
    ids: frozenset[str]  # student number, login
    numbers: frozenset[str]  # what the platform itself counts people by
    name: str


@dataclass
class Rows:
    """From submissions to rows, by index; and why a row that looks right was not taken."""

    found: dict[int, int] = field(default_factory=dict)
    doubts: dict[int, str] = field(default_factory=dict)


def spoken_name(text: str) -> str:
    """`Lee, Ann` and `Ann Lee` are one name."""
    last, comma, first = text.partition(",")
    return folded(f"{first} {last}" if comma and "," not in first else text)


def number_at_end(text: str) -> str:
    """`Participant 123` is 123, in whatever language Moodle wrote it."""
    found = _NUMBER_AT_END.search(text)
    return found.group() if found else ""


def _emails(graded: Graded) -> frozenset[str]:
    return frozenset(word for word in map(folded, (graded.email, *graded.ids)) if "@" in word)


def _is_another(graded: Graded, person: Person) -> bool:
    """Whether a name or an email says so: numbers of different kinds may be alike by chance."""
    words, theirs = set(spoken_name(graded.name).split()), set(person.name.split())
    if words and theirs:
        return not (words <= theirs or theirs <= words)
    emails = _emails(graded)
    return bool(emails and person.emails and not emails & person.emails)


def _sure(graded: Graded, people: Sequence[Person]) -> tuple[list[int], list[int]]:
    """The rows that an email address or a number speaks for, and those that a number alone does against the rest."""
    emails, ids, numbers = _emails(graded), set(map(folded, graded.ids)), set(map(folded, graded.numbers))
    by_email = [at for at, one in enumerate(people) if emails & one.emails]
    by_id = [at for at, one in enumerate(people) if ids & one.ids]
    by_number = [at for at, one in enumerate(people) if numbers & one.numbers] if not by_email else []
    words = {at for at in by_id if any(not word.isdecimal() for word in ids & people[at].ids)}
    alone = [at for at in (*by_id, *by_number) if at not in words and at not in by_email]
    doubtful = [at for at in alone if _is_another(graded, people[at])]
    return sorted({*by_email, *by_id, *by_number} - set(doubtful)), doubtful


def match(graded: Sequence[Graded], people: Sequence[Person]) -> Rows:
    """One that fits no row is left out. Whatever fits twice is an error."""
    rows = Rows()
    taken: dict[int, int] = {}
    for at, one in enumerate(graded):
        fits, doubtful = _sure(one, people)
        name = spoken_name(one.name)
        fits = fits or [row for row, person in enumerate(people) if name and person.name == name]
        if len(fits) > 1:
            which = listed([people[row].label for row in fits])
            raise UsageError(f"{one.label} fits more than one row: {which}; make their identities differ")
        if not fits:
            if doubtful:
                rows.doubts[at] = f"{people[doubtful[0]].label} has that number, but another name or email address"
            continue
        if fits[0] in taken:
            both = listed([graded[taken[fits[0]]].label, one.label])
            raise UsageError(f"{both} both fit {people[fits[0]].label}; remove one of them from results.csv")
        rows.found[at] = fits[0]
        taken[fits[0]] = at
    return rows
