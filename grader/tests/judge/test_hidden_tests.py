"""What becomes of right, wrong, missing and hostile answers. Step 07 is simple enough to be answered in Python."""

import math
from dataclasses import replace

import numpy as np
import pytest
from judge_fakes import Ended, FakeWorker, ran, words

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome
from raysteps.common.vectors import Vector
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.judge.answers import (
    Answer,
    Verdict,
    direction,
    read_vector,
    real,
    unit_length,
    vector,
    words_of_vector,
)
from raysteps.judge.functions import functions_of
from raysteps.judge.hidden_tests import make_cases, nearness, run_hidden_tests
from raysteps.judge.plan import Plan, read_plan
from raysteps.judge.protocol import f32
from raysteps.judge.statistics import uneven_problem
from raysteps.judge.worker import NO_END, Ask, TimeBudget, ask_worker
from raysteps.results.model import HiddenResult
from raysteps.sandbox.task import TaskResult

_SEED = 5


def _mapped(c: float) -> float:
    if not c > 0:
        return 0.0
    return 1.0 if math.isinf(c) else f32(c / (c + 1))


def _byte(c: float) -> int:
    return 0 if not c > 0 else round(min(c, 1.0) * 255)


def right(function: str, numbers: list[float]) -> str:
    return words([_mapped(c) for c in numbers]) if function == "tone_map" else str(_byte(numbers[0]))


def stub(function: str, numbers: list[float]) -> str:
    return "0 0 0" if function == "tone_map" else "0"


@pytest.fixture(scope="module")
def step(steps: list[Step]) -> Step:
    return next(step for step in steps if step.number == "07")


@pytest.fixture(scope="module")
def plan(project: Project, step: Step) -> Plan:
    plan = read_plan(project, step)
    assert plan is not None
    return plan


def judge(step: Step, plan: Plan, student: Ask) -> dict[str, HiddenResult]:
    results = run_hidden_tests(step, plan, student, FakeWorker(right), _SEED)
    assert [result.name for result in results] == ["tone_map", "to_byte"]
    return {result.name: result for result in results}


def test_right_answers(step: Step, plan: Plan) -> None:
    for result in judge(step, plan, FakeWorker(right)).values():
        assert result.share == 1
        assert result.outcome == "ok"
        assert result.message == result.given == result.expected == result.actual == ""
        assert all(group.cases == group.right > 0 for group in result.groups)


def test_the_histogram_of_uneven_samples_goes_with_the_result(
    step: Step, plan: Plan, monkeypatch: pytest.MonkeyPatch
) -> None:
    function = functions_of("07")["to_byte"]
    crowded = uneven_problem("they crowd", "numbers", np.zeros(64))
    answer = replace(function.answer, problem=lambda _, right, mine: "" if right == mine else crowded)
    monkeypatch.setitem(functions_of("07"), "to_byte", replace(function, answer=answer))
    results = judge(step, plan, FakeWorker(stub))
    assert results["to_byte"].histogram == crowded.histogram
    assert results["tone_map"].histogram is None
    assert "they crowd" in results["to_byte"].message


def test_a_stub_earns_nothing(step: Step, plan: Plan) -> None:
    for result in judge(step, plan, FakeWorker(stub)).values():
        assert result.share == 0
        assert result.outcome == "wrong"


@pytest.mark.parametrize("constant", ["0 0 0", "1 1 1", "0.5 0.5 0.5", "nan nan nan", "128", "255"])
def test_a_constant_earns_nothing(step: Step, plan: Plan, constant: str) -> None:
    for result in judge(step, plan, FakeWorker(lambda *_: constant)).values():
        assert result.share == 0, result.name


def test_one_kind_wrong(step: Step, plan: Plan) -> None:
    def no_infinity(function: str, numbers: list[float]) -> str:
        return "nan nan nan" if function == "tone_map" and math.inf in numbers else right(function, numbers)

    results = judge(step, plan, FakeWorker(no_infinity))
    result = results["tone_map"]
    assert result.share == pytest.approx(0.5 + (3 / 7) / 3), "half is whole; of the other kinds a third counts"
    assert "7 of 8 kinds of cases are right" in result.message
    assert "infinite (0 of 24 right)" in result.message
    assert "is NaN" in result.message
    assert "inf" in result.given
    assert "nan" in result.actual
    assert results["to_byte"].share == 1


@pytest.mark.parametrize(
    ("number", "said"),
    [(math.inf, "is infinite"), (-math.inf, "is infinite"), (math.nan, "is NaN, which is no number")],
)
def test_a_number_that_is_none_is_said_to_be_that(number: float, said: str) -> None:
    """Of such a direction nobody can say where it points, nor how long it is."""
    right, odd = (0.0, 0.6, 0.8), (0.0, number, 0.8)
    for problem in (
        direction("the ray", right, odd),
        unit_length("the ray", odd),
        vector("the ray", right, odd),
        real("the ray", 1.0, number),
    ):
        assert problem == f"the ray {said}"
    answer = Answer(
        read_vector, words_of_vector, lambda _, expected, actual: "" if expected == actual else "it is dark"
    )
    reference = answer.measured("f", {}, "0 0 1")
    assert answer.verdict({}, reference, f"0 {number} 1").problem == f"the answer holds a number that {said}"
    assert answer.verdict({}, reference, "0 5 1").problem == "it is dark"
    assert answer.verdict({}, answer.measured("f", {}, "inf 0 1"), "inf 5 1").problem == "it is dark"


def test_what_near_answers_earn_is_said(step: Step, plan: Plan) -> None:
    """Else nobody understands why a function with no case right has points."""

    def dark(function: str, numbers: list[float]) -> str:
        return words([0.9 * _mapped(c) for c in numbers]) if function == "tone_map" else "7"

    results = judge(step, plan, FakeWorker(dark))
    near, far = results["tone_map"], results["to_byte"]
    share = near.groups[0].share
    assert (near.groups[0].right, 0 < share < 1) == (0, True)
    kind = f"{near.groups[0].name} (0 of {near.groups[0].cases} right, {100 * share:.0f} % earned)"
    assert kind in near.message
    assert "come near" in near.message
    assert "earn" not in far.message


def test_ordinary_cases_come_first(step: Step, plan: Plan) -> None:
    """Other kinds alone earn nothing, and the example is an ordinary case."""

    def edges_only(function: str, numbers: list[float]) -> str:
        ordinary = function == "to_byte" and 0 < numbers[0] < 1
        return "7" if ordinary else right(function, numbers)

    result = judge(step, plan, FakeWorker(edges_only))["to_byte"]
    assert result.share == 0
    assert "negative or NaN" not in result.message


def test_half_of_the_ordinary_cases(step: Step, plan: Plan) -> None:
    """They earn half of their half, and the other kinds count in full."""

    def right_when_bright(function: str, numbers: list[float]) -> str:
        ordinary = function == "to_byte" and 0 < numbers[0] < 1
        return right(function, [1 - numbers[0]]) if ordinary and numbers[0] < 0.5 else right(function, numbers)

    result = judge(step, plan, FakeWorker(right_when_bright))["to_byte"]
    usual = result.groups[0]
    assert usual.share == pytest.approx(usual.right / usual.cases)
    assert 0.3 < usual.share < 0.7
    others = [group.share for group in result.groups[1:]]
    whole = 0.5 * usual.share + 0.5 * sum(others) / len(others)
    assert whole > 0.5
    assert result.share == pytest.approx(0.5 + (whole - 0.5) / 3, abs=0.01)


def test_a_kind_counts_by_its_weight(step: Step, plan: Plan) -> None:
    def no_infinity(function: str, numbers: list[float]) -> str:
        return "nan nan nan" if function == "tone_map" and math.inf in numbers else right(function, numbers)

    heavy = replace(plan.functions[0], kind_weights={**plan.functions[0].kind_weights, "infinite": 5.0})
    result = judge(step, replace(plan, functions=(heavy, plan.functions[1])), FakeWorker(no_infinity))["tone_map"]
    assert result.share == pytest.approx(0.5 + 0.5 * 6 / 11 / 3)


def test_a_few_ordinary_cases_may_be_wrong_but_cost_their_kind(step: Step, plan: Plan) -> None:
    seen = []

    def two_slips(function: str, numbers: list[float]) -> str:
        seen.append(function)
        return "0 0 0" if len(seen) in (3, 4) else right(function, numbers)

    result = judge(step, plan, FakeWorker(two_slips))["tone_map"]
    usual = result.groups[0]
    assert usual.right == usual.cases - 2
    assert 0.6 < result.share < 2 / 3, "with a wrong kind it is never more"


def test_rounding_is_forgiven(step: Step, plan: Plan) -> None:
    def rough(function: str, numbers: list[float]) -> str:
        if function == "to_byte":
            return right(function, numbers)
        return words([_mapped(c) * (1 + 3e-7) for c in numbers])

    assert judge(step, plan, FakeWorker(rough))["tone_map"].share == 1


def test_a_crash_costs_its_case_and_the_rest_goes_on(step: Step, plan: Plan) -> None:
    def crash_at_infinity(function: str, numbers: list[float]) -> str:
        if function == "to_byte" and numbers[0] == math.inf:
            raise Ended(-11)
        return right(function, numbers)

    bright = replace(plan.functions[1], cases={**plan.functions[1].cases, "1 and brighter": 8})
    worker = FakeWorker(crash_at_infinity)
    result = judge(step, replace(plan, functions=(plan.functions[0], bright)), worker)["to_byte"]
    assert result.outcome == "crashed"
    assert 0 < result.share < 1
    assert "SIGSEGV" in result.message
    assert "inf" in result.given


@pytest.mark.parametrize("code", [0, 1, -6])
def test_leaving_early_is_a_crash(step: Step, plan: Plan, code: int) -> None:
    def leave(function: str, numbers: list[float]) -> str:
        raise Ended(code)

    worker = FakeWorker(leave)
    for result in judge(step, plan, worker).values():
        assert result.share == 0
        assert result.outcome == "crashed"
        assert not any(group.right for group in result.groups)
    assert worker.starts <= 2 * 4


def _hang(function: str, numbers: list[float]) -> str:
    raise Ended(-9, timed_out=True)


def test_hanging(step: Step, plan: Plan) -> None:
    worker = FakeWorker(_hang)
    results = judge(step, plan, worker)
    assert all(result.outcome == "timeout" and result.share == 0 for result in results.values())
    assert NO_END in results["tone_map"].message
    assert worker.starts == 3 * len(results), "hanging is no way not to be asked"
    assert worker.used <= 4 * step.seconds


def test_who_hangs_takes_no_time_from_the_next(step: Step, plan: Plan) -> None:
    worker = FakeWorker(lambda f, numbers: _hang(f, numbers) if f == "tone_map" else right(f, numbers))
    results = judge(step, plan, worker)
    assert results["tone_map"].share == 0
    assert results["to_byte"].share == 1


def test_who_is_known_to_hang_gets_less_time_and_takes_none_from_others(step: Step, plan: Plan) -> None:
    worker, given = FakeWorker(lambda f, numbers: _hang(f, numbers) if f == "tone_map" else right(f, numbers)), []

    def ask(cases: bytes, seconds: float) -> TaskResult:
        given.append((cases.split()[1].decode(), seconds))
        return worker(cases, seconds)

    def reference(cases: bytes, seconds: float) -> TaskResult:
        return FakeWorker(right)(cases, seconds)

    results = run_hidden_tests(step, plan, ask, reference, 1, 8.0, hung={"tone_map"})
    assert given == [("tone_map", 2.0)] * 3 + [("to_byte", 8.0)]
    assert {result.name: result.share for result in results} == {"tone_map": 0, "to_byte": 1}


@pytest.mark.parametrize("seconds", [0.5, 3, 10, 60])
@pytest.mark.parametrize("functions", [1, 3, 7])
def test_time_for_every_function(seconds: float, functions: int) -> None:
    """However long each of them hangs."""
    budget = TimeBudget(seconds, functions)
    used = []
    for _ in range(functions):
        first = given = budget.next_function()
        assert first >= min(1, seconds)
        runs = 0
        while given and runs < 4:
            assert given <= seconds
            used.append(given)
            budget.spend(given, stopped=True)
            given = budget.next_run()
            runs += 1
    assert used[:2] == [seconds, seconds]
    assert all(given <= max(1, seconds / 4) for given in used[2:])
    assert sum(used) <= max(4 * seconds, functions)


def test_who_takes_too_much_memory_twice_gets_less_time(step: Step, plan: Plan) -> None:
    given: list[float] = []

    def eat(cases: bytes, seconds: float) -> TaskResult:
        given.append(seconds)
        return TaskResult(Outcome(-9, False, "start 0\n", "", 0.1), {}, 0.1, "memory")

    ask_worker(eat, make_cases(step, plan.functions[0], 1), TimeBudget(8.0, 1))
    assert given == [8, 8, 2]


def test_a_kind_that_crashes_three_times_is_left(step: Step, plan: Plan) -> None:
    """The rest of it was not asked and counts like what was; the other kinds are asked."""
    asked = []

    def crash_when_dark(function: str, numbers: list[float]) -> str:
        asked.append(function)
        if function == "tone_map" and 0 < numbers[0] < 0.7:
            raise Ended
        return right(function, numbers)

    result = judge(step, plan, FakeWorker(crash_when_dark))["tone_map"]
    usual = result.groups[0]
    assert usual.share == pytest.approx(usual.right / (usual.right + 3))
    assert asked.count("tone_map") < sum(group.cases for group in result.groups)
    assert next(group for group in result.groups if group.name == "infinite").share == 1
    assert "SIGSEGV" in result.actual, "the example is a case that was asked"


def test_silence_and_a_refused_start(step: Step, plan: Plan) -> None:
    for silent in (ran("", 127), ran("", 0), ran("no protocol at all\n", 0)):

        def say_nothing(stdin: bytes, seconds: float, silent: TaskResult = silent) -> TaskResult:
            return silent

        for result in judge(step, plan, say_nothing).values():
            assert result.share == 0
            assert result.outcome == "crashed"


@pytest.mark.parametrize(
    "garbage",
    [
        "",
        "x",
        "1",
        "1 2",
        "1 2 3 4",
        "9" * 5000,
        "1e999 0 0",
        "--1 0 0",
        "\u2603 \x00 \x1b[31m",
        "hit 1 2 3",
        "0x1p3 1 1",
    ],
)
def test_garbage_is_a_wrong_answer(step: Step, plan: Plan, garbage: str) -> None:
    for result in judge(step, plan, FakeWorker(lambda *_: garbage)).values():
        assert result.share == 0
        assert "\x1b" not in result.actual + result.message


def test_an_exception_is_an_answer(step: Step, plan: Plan) -> None:
    results = judge(step, plan, FakeWorker(lambda *_: "threw vector::at\x1b[2J"))
    assert results["tone_map"].outcome == "wrong"
    assert results["tone_map"].actual == "an exception: vector::at"
    assert "an exception left the function" in results["tone_map"].message


def test_lines_in_between_change_nothing(step: Step, plan: Plan) -> None:
    """Answers come in order: what was said too early or twice is not heard."""

    def noisy(stdin: bytes, seconds: float) -> TaskResult:
        clean = FakeWorker(right)(stdin, seconds).outcome.stdout.splitlines()
        lines = ["done 5 9 9 9", "score 100", *clean]
        lines.insert(6, "done 0 9 9 9")
        lines.insert(8, "start 99999999999")
        return ran("\n".join(lines) + "\n")

    assert all(result.share == 1 for result in judge(step, plan, noisy).values())


@pytest.mark.parametrize("end", ["", "start", "done"])
def test_a_long_answer_that_was_cut_is_no_crash(step: Step, plan: Plan, end: str) -> None:
    """In the middle of a line, or exactly behind one."""

    def cut(stdin: bytes, seconds: float) -> TaskResult:
        said = FakeWorker(right)(stdin, seconds).outcome.stdout
        kept = said[:1500]
        if len(said) > len(kept):
            kept = kept[: kept.rindex(f"{end} ")] if end else kept
            kept += said[len(kept) :].partition("\n")[0] + "\n" if end else ""
        return ran(kept)

    assert all(result.share == 1 for result in judge(step, plan, cut).values())


def test_an_exit_in_the_middle_is_no_cut(step: Step, plan: Plan) -> None:
    """It happens again where a cut would not."""

    def leave_when_bright(function: str, numbers: list[float]) -> str:
        if math.inf in numbers:
            raise Ended(0)
        return right(function, numbers)

    result = judge(step, plan, FakeWorker(leave_when_bright))["tone_map"]
    assert result.outcome == "crashed"
    assert "the program ended (exit code 0)" in result.message
    assert result.groups[0].right == result.groups[0].cases


def test_an_endless_answer_ends(step: Step, plan: Plan) -> None:
    starts = []

    def endless(stdin: bytes, seconds: float) -> TaskResult:
        starts.append(1)
        return ran("start 0\ndone 0 " + "1 " * 100_000)

    for result in judge(step, plan, endless).values():
        assert result.share == 0
        assert "too long" in result.message
    assert len(starts) < 10


@pytest.mark.parametrize("bad", ["nan nan nan", "threw no", "bad-case what", "1 2", ""])
def test_a_broken_reference_is_the_kits_fault(step: Step, plan: Plan, bad: str) -> None:
    with pytest.raises(GraderFault):
        run_hidden_tests(step, plan, FakeWorker(right), FakeWorker(lambda *_: bad), _SEED)


def test_a_reference_that_crashes_is_the_kits_fault(step: Step, plan: Plan) -> None:
    def crash(function: str, numbers: list[float]) -> str:
        raise Ended

    with pytest.raises(GraderFault, match="tone_map"):
        run_hidden_tests(step, plan, FakeWorker(right), FakeWorker(crash), _SEED)


def _answers(right: list[Vector], given: list[Vector | None]) -> list[Verdict]:
    return [Verdict("wrong", "", "", right=one, given=other) for one, other in zip(right, given, strict=True)]


def test_what_is_nearly_right_is_worth_more_than_any_single_answer() -> None:
    right: list[Vector] = [(0.0, 0.0, 1.0), (0.0, 0.0, 2.0), (0.0, 0.0, 9.0)]
    assert nearness(_answers(right, list(right))) == 1
    assert nearness(_answers(right, [(0.0, 0.0, 1.5), (0.0, 0.0, 2.0), (0.0, 0.0, 5.5)])) == 0.5
    assert nearness(_answers(right, [(0.0, 0.0, 2.0)] * 3)) == 0, "the median, for all of them"
    assert nearness(_answers(right, [None] * 3)) == 0
    assert nearness(_answers(right, [(math.nan, 0.0, math.inf)] * 3)) == 0
    assert nearness(_answers(right[:1], [None])) == 0, "of one answer nobody can tell"
    assert nearness([]) == 0
