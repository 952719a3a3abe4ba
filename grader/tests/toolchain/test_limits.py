"""The limits of a step: its manifest, and what a course changes."""

from dataclasses import replace

import pytest

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.toolchain.limits import limits_of, parse_limits

pytestmark = pytest.mark.portable


def test_a_course_changes_what_the_manifest_says(steps: list[Step]) -> None:
    step = replace(steps[0], more_limits=(("compile_seconds", 9.0), ("processes", 5.0)))
    limits = limits_of(step, {})
    assert (limits.seconds, limits.memory_mb) == (step.seconds, step.memory_mb)
    assert (limits.compile_seconds, limits.processes) == (9, 5)
    changed = limits_of(step, parse_limits(["processes=7", "seconds=0.5", "memory_mb=100"]))
    assert (changed.processes, changed.seconds, changed.memory_mb, changed.compile_seconds) == (7, 0.5, 100, 9)


def test_a_busy_machine_stops_neither_compiler_nor_program(steps: list[Step]) -> None:
    limits = limits_of(steps[0], {})
    for most in (limits.of_tools(), limits.of_program()):
        assert most.wall_seconds == 4 * most.cpu_seconds


@pytest.mark.parametrize(
    "word", ["seconds", "seconds=", "seconds=0", "seconds=-1", "processes=1.5", "memory_mb=0", "x=1"]
)
def test_limits_that_make_no_sense(word: str) -> None:
    with pytest.raises(UsageError, match="expected one of"):
        parse_limits([word])


def test_a_step_that_hung_twice_gets_less_time_but_never_more(steps: list[Step]) -> None:
    def seconds(limit: float) -> list[float]:
        limits, found = limits_of(steps[0], {"seconds": limit}), []
        for _ in range(4):
            found.append(limits.seconds)
            limits = limits.after_a_stop()
        return found

    assert seconds(8.0) == [8, 8, 2, 2]
    assert seconds(0.5) == [0.5, 0.5, 0.5, 0.5]


def test_a_slow_machine_has_more_time_where_nobody_says_otherwise(steps: list[Step]) -> None:
    assert limits_of(steps[0], {}, 3.0).seconds == 3 * steps[0].seconds
    assert limits_of(steps[0], {"seconds": 8.0}, 3.0).seconds == 8


def test_seconds_are_processor_time_and_four_times_that_on_the_clock(steps: list[Step]) -> None:
    limits = limits_of(steps[0], {"seconds": 8.0}).of_program()
    assert (limits.cpu_seconds, limits.wall_seconds) == (8, 32)
    assert limits_of(steps[0], {"seconds": 8.0}).of_program(2.0).wall_seconds == 8
