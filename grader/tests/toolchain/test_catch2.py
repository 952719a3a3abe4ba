"""Catch2's XML, both generations, complete or not."""

import pytest

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
    assert (bad.failure.expression, bad.failure.expanded) == ("a == b", "1 == 2")
    assert (bad.failure.location, bad.failure.notes) == ("a_test.cpp:9", "inner\nthe ray goes up")


def test_sections_without_end_hold_nothing_up() -> None:
    """A forged report: what lies deeper than any test of ours is not looked for."""
    deep = '<Section name="a">' * 5000 + "<Failure/>" + "</Section>" * 5000
    outcomes = parse_report(VERSION_3.replace('<Section name="inner">', f'{deep}<Section name="inner">').encode())
    assert outcomes is not None
    assert outcomes[1].failure is not None
    assert outcomes[1].failure.expression == "a == b"


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


@pytest.mark.parametrize(
    ("original", "expanded", "expected", "actual"),
    [
        ("!(is_lit(scene, hit, light))", "!true", "is_lit(scene, hit, light) is false", "true"),
        ("is_lit(scene, hit, light)", "false", "is_lit(scene, hit, light)", "false"),
        ("!(a) == !(b)", "true == false", "!(a) == !(b)", "true == false"),
    ],
)
def test_nobody_has_to_read_a_double_negation(original: str, expanded: str, expected: str, actual: str) -> None:
    failure = _failing(_expression(original, expanded))
    assert (failure.expression, failure.expanded) == (expected, actual)


def test_sections_around_a_failure_say_what_it_is_about() -> None:
    """And not those before it, nor notes of an assertion that held."""
    before = f'<Section name="one light"><Info>a</Info>{_expression("x", "x", "true")}</Section><Info>seed</Info>'
    around = (
        f'<Section name="two lights"><Section name="the sum"><Info>b</Info>{_expression("x", "y")}</Section></Section>'
    )
    assert _failing(before + around).notes == "two lights\nthe sum\nb"
    assert _failing(f'{before}<Section name="no light">{_expression("x", "y")}</Section>').notes == "no light"
    assert _failing(_expression("x", "y")).notes == ""
