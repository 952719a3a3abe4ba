"""Catch2's XML, both generations, complete or not."""

import pytest

from raysteps.common.catch_report import parse_report

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
    assert good.tags == {"04-shadows", "is_lit"}
    assert not bad.passed
    assert bad.failure is not None
    assert (bad.failure.expression, bad.failure.expanded) == ("a == b", "1 == 2")
    assert (bad.failure.location, bad.failure.notes) == ("a_test.cpp:9", "the ray goes up")


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
