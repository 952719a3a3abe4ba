"""A wrong case becomes the smallest one that is wrong in the same way. Step 07 is answered in Python, others by a
worker that is linked with a mistake."""

import itertools
import json
import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from judge_fakes import Ended, FakeWorker

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.judge.choice_sequence import (
    InvalidChoice,
    Recorder,
    Replay,
    complexity,
    cost,
    simpler_directions,
    simpler_reals,
)
from raysteps.judge.counterexamples import Counterexamples, choices_of
from raysteps.judge.decode_case import decode_inputs
from raysteps.judge.functions import Case, Function, functions_of
from raysteps.judge.hidden_tests import run_hidden_tests
from raysteps.judge.plan import Plan, read_plan
from raysteps.judge.protocol import f32
from raysteps.judge.random_source import RandomSource
from raysteps.judge.shrink_passes import Change, Recipe, changes, live_choices, make
from raysteps.judge.worker import Ask, ask_student, uncached_reference_answers
from raysteps.results.model import HiddenResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import TaskResult
from raysteps.toolchain.compile import StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import limits_of

_SEED = 1


def _step(steps: list[Step], number: str) -> Step:
    return next(step for step in steps if step.number == number)


def _plan(project: Project, step: Step) -> Plan:
    plan = read_plan(project, step)
    assert plan is not None
    return plan


def _all_groups(steps: list[Step]) -> list[tuple[Function, str]]:
    return [(f, group.name) for step in steps for f in functions_of(step.number).values() for group in f.groups]


def _recorded(function: Function, group: str, seed: str) -> tuple[Recorder, Case]:
    draw = Recorder(seed)
    return draw, Case(function.name, group, function.by_name[group].make(draw))


# --- choices ---


def test_a_recorder_draws_what_anybody_draws(steps: list[Step]) -> None:
    for function, group in _all_groups(steps):
        _, case = _recorded(function, group, "3")
        plain = Case(function.name, group, function.by_name[group].make(RandomSource("3")))
        assert case.line(0) == plain.line(0)


def test_recorded_choices_make_the_same_case_again(steps: list[Step]) -> None:
    for function, group in _all_groups(steps):
        draw, case = _recorded(function, group, "4")
        replay = Replay([choice.value for choice in draw.choices])
        again = Case(function.name, group, function.by_name[group].make(replay))
        assert again.line(0) == case.line(0), f"{function.name}, {group}"
        assert replay.choices == draw.choices


def test_no_choices_at_all_end_soon(steps: list[Step]) -> None:
    """Whatever is left out is simple, or there is no such case; nothing is tried for ever."""
    made = [make(function, group, Recipe(())) for function, group in _all_groups(steps)]
    assert sum(candidate is not None for candidate in made) > len(made) // 4


def test_choices_out_of_bounds_are_brought_back() -> None:
    draw = Replay([99.0, 99, (0.0, 1.0, 0.0), 5.0])
    assert draw.real(0, 1) == 1
    assert draw.whole(2, 5) == 5
    assert draw.chance(0.5) is False, "a choice of another kind is left for later"
    assert draw.direction() == (0.0, 1.0, 0.0)
    assert draw.fine(1, 9) == 5
    with pytest.raises(InvalidChoice):
        draw.until(lambda _: False, lambda: 1)


def test_the_choices_of_a_later_case(steps: list[Step]) -> None:
    group = functions_of("02")["Sphere::intersect"].groups[0]
    draw = RandomSource("a seed")
    cases = [group.make(draw) for _ in range(4)]
    again = group.make(Replay([choice.value for choice in choices_of(group, "a seed", 3)]))
    assert again == cases[3] != cases[2]


def test_every_change_makes_a_case_of_its_kind_or_none(steps: list[Step]) -> None:
    """Unit vectors stay unit vectors, whatever is changed."""
    function = functions_of("03")["specular"]
    draw, _ = _recorded(function, "near the highlight", "5")
    base = make(function, "near the highlight", Recipe(tuple(choice.value for choice in draw.choices)))
    assert base is not None
    found = 0
    for change in changes(base, live_choices(function, base), may_drop=True):
        candidate = make(function, "near the highlight", change.of(base.recipe))
        for name in ("normal", "to_light", "to_eye") if candidate else ():
            assert candidate is not None
            numbers = [float(x) for x in candidate.case.inputs[name].numbers()]
            assert math.hypot(*numbers) == pytest.approx(1, abs=1e-6)
            found += 1
    assert found > 100


# --- what is simple ---


def test_the_order_of_numbers() -> None:
    rising = [0.0, 1.0, -1.0, 2.0, 0.5, 1.5, 0.25, 0.125, 0.7312]
    assert sorted(rising, key=cost) == rising
    assert cost(-0.0) > cost(2.0)


def test_simpler_numbers_stay_within_bounds() -> None:
    assert simpler_reals(0.7312, 0.2, 1.0)[0] == 1
    assert all(0.2 <= x <= 0.9 for x in simpler_reals(0.7312, 0.2, 0.9))
    assert all(math.hypot(*v) == pytest.approx(1, abs=1e-7) for v in simpler_directions((0.48, 0.64, 0.6)))


# --- step 07, answered in Python ---


def _right(function: str, numbers: list[float]) -> str:
    if function == "to_byte":
        return str(0 if not numbers[0] > 0 else round(min(numbers[0], 1.0) * 255))
    mapped = (0.0 if not c > 0 else 1.0 if math.isinf(c) else f32(c / (c + 1)) for c in numbers)
    return " ".join(str(c) for c in mapped)


def _judge_toned(
    project: Project, steps: list[Step], folder: Path, student: Ask, seed: int = _SEED
) -> dict[str, HiddenResult]:
    step, reference = _step(steps, "07"), FakeWorker(_right)
    examples = Counterexamples(student, reference, folder)
    results = run_hidden_tests(step, _plan(project, step), student, reference, seed, examples=examples)
    return {result.name: result for result in results}


def _unclamped(function: str, numbers: list[float]) -> str:
    bright = function == "tone_map" and any(c > 3 for c in numbers)
    return "0 0 0" if bright else _right(function, numbers)


def test_a_round_example(project: Project, steps: list[Step], tmp_path: Path) -> None:
    result = _judge_toned(project, steps, tmp_path, FakeWorker(_unclamped))["tone_map"]
    assert result.given in ("color: (4, 1, 1)", "color: (1, 4, 1)", "color: (1, 1, 4)")
    assert result.expected in ("(0.8, 0.5, 0.5)", "(0.5, 0.8, 0.5)", "(0.5, 0.5, 0.8)")
    assert result.actual == "(0, 0, 0)"
    assert result.case == "cases/07-tone-map.json"
    case = json.loads((tmp_path / result.case).read_text("utf-8"))
    assert (case["step"], case["function"], case["kind"]) == ("07-tone-mapping", "tone_map", "any colour")
    assert case["given"] == result.given
    assert case["problem"] == "the colour is wrong"


def test_right_functions_have_no_example(project: Project, steps: list[Step], tmp_path: Path) -> None:
    for result in _judge_toned(project, steps, tmp_path, FakeWorker(_right)).values():
        assert result.share == 1
        assert result.case == ""
    assert not (tmp_path / "cases").exists()


def test_the_same_example_every_time(project: Project, steps: list[Step], tmp_path: Path) -> None:
    first = _judge_toned(project, steps, tmp_path / "1", FakeWorker(_unclamped))
    again = _judge_toned(project, steps, tmp_path / "2", FakeWorker(_unclamped))
    assert {name: vars(result) for name, result in first.items()} == {n: vars(r) for n, r in again.items()}
    files = [(tmp_path / number / "cases" / "07-tone-map.json").read_bytes() for number in "12"]
    assert files[0] == files[1]


def test_points_do_not_depend_on_the_example(project: Project, steps: list[Step], tmp_path: Path) -> None:
    step = _step(steps, "07")
    shrunk = _judge_toned(project, steps, tmp_path, FakeWorker(_unclamped))
    plain = run_hidden_tests(step, _plan(project, step), FakeWorker(_unclamped), FakeWorker(_right), _SEED)
    for result in plain:
        other = shrunk[result.name]
        assert (result.share, result.groups, result.message) == (other.share, other.groups, other.message)


def _when_bright(action: Callable[[], str]) -> Callable[[str, list[float]], str]:
    def answer(function: str, numbers: list[float]) -> str:
        return action() if function == "tone_map" and any(c > 3 for c in numbers) else _right(function, numbers)

    return answer


def _crash() -> str:
    raise Ended(-11)


def _hang() -> str:
    raise Ended(-9, timed_out=True)


def _complexity(result: HiddenResult) -> float:
    line = "1 tone_map " + result.given.removeprefix("color: (").rstrip(")").replace(",", "")
    return complexity(decode_inputs(functions_of("07")["tone_map"], line))[1]


def test_a_crash_is_shrunk(project: Project, steps: list[Step], tmp_path: Path) -> None:
    result = _judge_toned(project, steps, tmp_path, FakeWorker(_when_bright(_crash)))["tone_map"]
    assert result.outcome == "crashed"
    assert "SIGSEGV" in result.actual
    assert _complexity(result) <= cost(4) + 2 * cost(1)


def test_a_hang_costs_no_more_than_its_budget(project: Project, steps: list[Step], tmp_path: Path) -> None:
    worker = FakeWorker(_when_bright(_hang))
    without = FakeWorker(_when_bright(_hang))
    step = _step(steps, "07")
    run_hidden_tests(step, _plan(project, step), without, FakeWorker(_right), _SEED)
    result = _judge_toned(project, steps, tmp_path, worker)["tone_map"]
    assert result.outcome == "timeout"
    assert worker.used - without.used <= 8
    assert _complexity(result) < 10


@dataclass
class _Waiting:
    """A worker whose runs take so many seconds of the clock and hardly any of a processor."""

    worker: Ask
    seconds: float
    runs: int = 0

    def __call__(self, questions: bytes, seconds: float) -> TaskResult:
        self.runs += 1
        ran = self.worker(questions, seconds)
        return replace(ran, outcome=replace(ran.outcome, seconds=self.seconds), cpu_seconds=0.01)


def test_a_slow_judge_shows_the_same_example(
    project: Project, steps: list[Step], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However much time passes beside the student's program."""
    quick, waited_for = (_Waiting(FakeWorker(_unclamped), 0.01) for _ in range(2))
    first = _judge_toned(project, steps, tmp_path / "1", quick)["tone_map"]
    clock = itertools.count(step=30.0)  # it moves on by so much whenever somebody looks
    monkeypatch.setattr(time, "monotonic", lambda: next(clock))
    assert _judge_toned(project, steps, tmp_path / "2", waited_for)["tone_map"].given == first.given
    assert quick.runs == waited_for.runs


def test_a_program_that_sleeps_comes_to_an_end(project: Project, steps: list[Step], tmp_path: Path) -> None:
    awake, asleep = (_Waiting(FakeWorker(_unclamped), seconds) for seconds in (0.01, 21.0))
    assert _judge_toned(project, steps, tmp_path / "1", awake)["tone_map"].given
    assert _judge_toned(project, steps, tmp_path / "2", asleep)["tone_map"].given
    step, judged = _step(steps, "07"), _Waiting(FakeWorker(_unclamped), 21.0)
    run_hidden_tests(step, _plan(project, step), judged, FakeWorker(_right), _SEED)
    assert asleep.runs == judged.runs + 1 < awake.runs


@pytest.mark.parametrize("garbage", ["", "x", "1 2", "9" * 5000, "--1 0 0", "\u2603 \x00 \x1b[31m", "threw \x1b[2J"])
def test_garbage_is_shrunk_like_any_answer(project: Project, steps: list[Step], tmp_path: Path, garbage: str) -> None:
    result = _judge_toned(project, steps, tmp_path, FakeWorker(lambda *_: garbage))["tone_map"]
    assert result.given == "color: (1, 1, 1)"
    assert "\x1b" not in (tmp_path / result.case).read_text("utf-8")


def test_an_answer_that_changes_its_mind(project: Project, steps: list[Step], tmp_path: Path) -> None:
    """Wrong at first, and right as soon as it is asked for examples: what was seen is shown."""
    asked = []

    def fickle(function: str, numbers: list[float]) -> str:
        asked.append(function)
        return "0 0 0" if asked.count("tone_map") < 30 else _right(function, numbers)

    result = _judge_toned(project, steps, tmp_path, FakeWorker(fickle))["tone_map"]
    assert result.actual == "(0, 0, 0)"
    assert result.given


# --- planted mistakes ---


@dataclass(frozen=True)
class _Planted:
    number: str
    function: str
    old: str
    new: str
    given: str


_FAR_ROOT = _Planted(
    "02",
    "Sphere::intersect",
    "nearer > 0.0F ? nearer : to_closest + half_chord",
    "to_closest + half_chord",
    "sphere at (0, 0, 0) radius 1 ",
)
_LAST_ONE = _Planted(
    "02",
    "closest_hit",
    "hit->distance < closest->distance",
    "hit->distance > closest->distance",
    "surfaces: 1: a surface hit at 2; 2: a surface hit at 1; ray: from (0, 0, 0) towards (0, 0, 1)",
)
_NO_LIMIT = _Planted(
    "05",
    "trace",
    "depth > tracer.max_ray_depth()",
    "depth >= tracer.max_ray_depth()",
    "ray: from (0, 0, 0) towards",
)


def _build(kit: BuiltKit, step: Step, source: str, folder: Path) -> Ask:
    box, limits = LimitsOnly(), limits_of(step, {})
    build = StudentBuild(kit, box, folder)
    compiled = build.compile(step, source.encode(), limits)
    assert compiled.binary is not None, compiled.ran.outcome.stderr
    program, _ = build.program("worker", step, {step.number: compiled.binary}, limits)
    assert program is not None
    return ask_student(box, program, limits)


@pytest.mark.parametrize("planted", [_FAR_ROOT, _LAST_ONE, _NO_LIMIT])
def test_a_planted_mistake(
    project: Project, kit: BuiltKit, solved: dict[str, str], tmp_path: Path, planted: _Planted
) -> None:
    step = _step(list(kit.steps), planted.number)
    assert solved[step.id].count(planted.old) == 1
    student = _build(kit, step, solved[step.id].replace(planted.old, planted.new), tmp_path / "build")

    def reference(cases: bytes, _seconds: float) -> TaskResult:
        return uncached_reference_answers(kit, cases)

    examples = Counterexamples(student, reference, tmp_path)
    results = run_hidden_tests(step, _plan(project, step), student, reference, _SEED, examples=examples)
    (wrong,) = [result for result in results if result.share < 1]
    assert wrong.name == planted.function
    assert wrong.given.removeprefix("sphere: ").startswith(planted.given), wrong.given
    assert wrong.expected != wrong.actual
    numbers = json.loads((tmp_path / wrong.case).read_text("utf-8"))["line"].split()[2:]
    assert all(len(number.lstrip("-")) <= 4 for number in numbers), wrong.given


def test_changes_go_together() -> None:
    both = Change(((0, 1.0), (2, 3))).and_then(Change(((0, 5.0), (1, True)), frozenset({("rays", 1)})))
    assert dict(both.values) == {0: 1.0, 1: True, 2: 3}
    assert both.dropped == {("rays", 1)}
