"""Whose row it is: the kinds of numbers that platforms and courses give to people are not mixed up."""

import pytest

from raysteps.common.errors import UsageError
from raysteps.exports.class_results import GradedStudent, Person, match

pytestmark = pytest.mark.portable


def _graded(submission: str = "x", id: str = "", name: str = "", email: str = "") -> GradedStudent:  # noqa: A002
    return GradedStudent(submission, id, name, email, 1.0, 1.0, 10.0)


def _person(label: str, email: str = "", id: str = "", number: str = "", name: str = "") -> Person:  # noqa: A002
    emails, ids, numbers = (frozenset(filter(None, [word])) for word in (email, id, number))
    return Person(label, emails, ids, numbers, name)


_PEOPLE = [
    _person("Ann", "ann@x", "102", "7001", "ann lee"),
    _person("Bob", "bob@x", "103", "102", "bob ray"),
    _person("Cleo", "cleo@x", "s5", "7001555", "cleo fox"),
]


@pytest.mark.parametrize(
    ("who", "row"),
    [
        (_graded(id="102", name="Ann Lee", email="ann@x"), 0),
        (_graded(id="102", email="bob@x"), 1),  # an email address is better evidence than a number
        (_graded(id="s5", email="bob@x"), "more than one row: Bob and Cleo"),  # but not better than a login
        (_graded(id="102", name="Ann"), 0),  # her ID number, and not the number that the platform gave Bob
        (_graded(id="102", name="Bob Ray"), 1),
        (_graded(id="102"), "more than one row: Ann and Bob"),
        (_graded(id="102", name="Dan Day", email="dan@x"), None),  # only chance makes his number that of others
        (_graded(id="7001", name="Dan Day"), None),
        (_graded(id="7001", email="dan@x"), None),
        (_graded(id="7001", name="Lee, Ann"), 0),
        (_graded(id="7001"), 0),
        (_graded(id="7001", name="Bob Ray"), 1),  # then the name tells
        (_graded(id="7001", email="bob@x"), 1),
        (_graded(id="s5", name="C. Fox", email="fox@elsewhere"), 2),  # no number that may be of any kind
        (_graded(id="cleo@x"), 2),
        (_graded("foxcleo_7001555_12_steps"), 2),
        (_graded("leeann_102_12_steps"), 1),  # the number of a download is the platform's own
        (_graded("x_1_2_7001555_12_steps"), None),  # and stands at the beginning
        (_graded("Ann_7001_assignsubmission_file_7001555_assignsubmission_"), 0),
    ],
)
def test_evidence(who: GradedStudent, row: int | str | None) -> None:
    if isinstance(row, str):
        with pytest.raises(UsageError, match=row):
            match([who], _PEOPLE)
        return
    assert match([who], _PEOPLE).found == ({} if row is None else {0: row})


def test_a_number_that_was_not_believed_is_told() -> None:
    rows = match([_graded(id="7001", name="Dan Day")], _PEOPLE)
    assert rows.doubts == {0: "Ann has that number, but another name or email address"}
