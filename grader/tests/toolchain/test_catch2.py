"""Catch2's XML, both generations, complete or not."""

from xml.sax.saxutils import unescape

import pytest
from catch2_words import COMPARISONS

from raysteps.toolchain.catch2 import Failure, parse_report

pytestmark = pytest.mark.portable

CASES = """<TestCase name="good" tags="[04-shadows][is_lit]" filename="/k/a_test.cpp" line="3">
<OverallResult success="true"/></TestCase>
<TestCase name="bad" filename="/k/a_test.cpp" line="7"><Section name="inner">
<Info>the ray goes up</Info>
<Expression success="false" type="REQUIRE" filename="/k/a_test.cpp" line="9">
<Original>a == b</Original><Expanded>1 == 2</Expanded></Expression></Section>
<OverallResult success="false"/></TestCase>
"""
TOTALS = '<OverallResultsCases successes="1" failures="1" expectedFailures="0"/>'
VERSION_2 = f'<?xml version="1.0"?><Catch name="t"><Group name="t">{CASES}{TOTALS}</Group>{TOTALS}</Catch>'
VERSION_3 = f'<?xml version="1.0"?><Catch2TestRun name="t">{CASES}{TOTALS}</Catch2TestRun>'


@pytest.mark.parametrize("text", [VERSION_2, VERSION_3])
def test_complete_reports(text: str) -> None:
    outcomes = parse_report(text.encode())
    assert outcomes is not None
    good, bad = outcomes
    assert good.passed
    assert not bad.passed
    assert bad.failure is not None
    assert (bad.failure.expected, bad.failure.got) == ("a = 2", "a = 1")
    assert (bad.failure.location, bad.failure.notes) == ("a_test.cpp:9", "inner\nthe ray goes up")


def test_a_failure_in_a_helper_names_the_test_that_called_it() -> None:
    outcomes = parse_report(VERSION_3.replace('a_test.cpp" line="9"', 'hits.hpp" line="28"').encode())
    assert outcomes is not None
    assert outcomes[1].failure is not None
    assert outcomes[1].failure.location == "a_test.cpp:7, fails in hits.hpp:28"


def test_sections_without_end_hold_nothing_up() -> None:
    """A forged report: what lies deeper than any test of ours is not looked for."""
    deep = '<Section name="a">' * 5000 + "<Failure/>" + "</Section>" * 5000
    outcomes = parse_report(VERSION_3.replace('<Section name="inner">', f'{deep}<Section name="inner">').encode())
    assert outcomes is not None
    assert outcomes[1].failure is not None
    assert outcomes[1].failure.expected == "a = 2"


@pytest.mark.parametrize(
    "text",
    [
        "",
        VERSION_3[:-10],
        VERSION_3.replace(TOTALS, ""),
        VERSION_3.replace('successes="1"', 'successes="2"'),
        VERSION_3.replace('name="bad"', 'name="good"'),
        '<!DOCTYPE x [<!ENTITY a "b">]>' + VERSION_3.partition("?>")[2],
    ],
)
def test_incomplete_or_odd_reports_do_not_count(text: str) -> None:
    assert parse_report(text.encode()) is None


def _failing(inside: str) -> Failure:
    totals = '<OverallResultsCases successes="0" failures="1"/>'
    case = f'<TestCase name="t">{inside}<OverallResult success="false"/></TestCase>'
    outcomes = parse_report(f"<Catch2TestRun>{case}{totals}</Catch2TestRun>".encode())
    assert outcomes is not None
    assert outcomes[0].failure is not None
    return outcomes[0].failure


def _expression(original: str, expanded: str, success: str = "false") -> str:
    words = f"<Original>{original}</Original><Expanded>{expanded}</Expanded>"
    return f'<Expression success="{success}" filename="a_test.cpp" line="9">{words}</Expression>'


@pytest.mark.parametrize(("original", "expanded", "expected", "got"), COMPARISONS)
def test_what_was_expected_and_what_came_have_a_name(original: str, expanded: str, expected: str, got: str) -> None:
    failure = _failing(_expression(original, expanded))
    assert (failure.expected, failure.got) == (unescape(expected), unescape(got))


def test_notes_hold_numbers_as_a_person_writes_them() -> None:
    note = "<Info>radius := 2.90297f</Info><Info>sphere(2.5f) := a ball: 1f</Info><Info>0.5f of it</Info>"
    assert (
        _failing(note + _expression("a", "false")).notes == "radius := 2.90297\nsphere(2.5f) := a ball: 1\n0.5f of it"
    )


def test_trouble_inside_a_test_is_told_in_words() -> None:
    thrown = _failing(
        _expression("shade(hit)", "shade(hit)").replace(
            "</Expression>", "<Exception> out of range </Exception></Expression>"
        )
    )
    assert (thrown.expected, thrown.got) == ("shade(hit)", "threw: out of range")
    outside = _failing("<Exception>vector::at</Exception>")
    assert (outside.expected, outside.got) == ("the test comes to its end", "threw: vector::at")
    failed = _failing("<Info>a ray</Info><Failure>it went the other way</Failure>")
    assert (failed.expected, failed.got, failed.notes) == ("", "", "a ray\nit went the other way")


@pytest.mark.parametrize(
    "sign", [b"\xed\xa0\x80", b"\xef\xbf\xbe", b"\xef\xbf\xbf", b"\xff", b"\xf4\x90\x80\x80", b"\x01"]
)
def test_words_that_are_no_text_hide_nothing(sign: bytes) -> None:
    """Halves of surrogates and what is no character: no XML holds them, and an exception may."""
    (before, after) = VERSION_3.replace("the ray goes up", "the ray HERE goes up").encode().split(b"HERE")
    outcomes = parse_report(before + sign + after)
    assert outcomes is not None
    assert [outcome.passed for outcome in outcomes] == [True, False]
    assert outcomes[1].failure is not None
    assert outcomes[1].failure.notes.startswith("inner\nthe ray")
    assert outcomes[1].failure.notes.endswith("goes up")


@pytest.mark.parametrize("sign", ["(", ")", ", ", " == ", "{(", " is expected to ", "9", "9.", " (0x"])
def test_values_of_any_shape_are_read_in_one_go(sign: str) -> None:
    """What a student's function gave is written out whole; it is cut before it is looked at."""
    failure = _failing(_expression(sign * 50_000, sign * 50_000))
    assert len(failure.expected) + len(failure.got) < 10_000


def test_sections_around_a_failure_say_what_it_is_about() -> None:
    """And not those before it, nor notes of an assertion that held."""
    before = f'<Section name="one light"><Info>a</Info>{_expression("x", "x", "true")}</Section><Info>seed</Info>'
    around = (
        f'<Section name="two lights"><Section name="the sum"><Info>b</Info>{_expression("x", "y")}</Section></Section>'
    )
    assert _failing(before + around).notes == "two lights\nthe sum\nb"
    assert _failing(f'{before}<Section name="no light">{_expression("x", "y")}</Section>').notes == "no light"
    assert _failing(_expression("x", "y")).notes == ""
