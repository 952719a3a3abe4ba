"""A function that is not written costs its own points only: the others are judged with the reference's in its place. So
are, in the hidden part, those after a function that is wrong."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Literal

import pytest
from conftest import Sources
from machine_code import reference_code

from raysteps.course.manifest import Step
from raysteps.course.stubs import make_stub
from raysteps.grading import pipeline
from raysteps.grading.pipeline import HiddenStepGrader, grade_submission
from raysteps.grading.scoring import still_missing
from raysteps.grading.scoring import test_weights as weights_of
from raysteps.judge.counterexamples import Counterexamples, read_case
from raysteps.judge.worker import JudgedCase
from raysteps.results.model import HiddenResult, Settings, StepResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import AccountingSandbox, Sandbox, Task, TaskResult
from raysteps.submission.load import Submission
from raysteps.toolchain.kit_artifacts import BuiltKit

_SEED = 20261123
# A call, a call of a member, a call of a virtual one, by a search and by a builder; and two in a row.
_IN_A_BOX = (("03", "mirror"), ("04", "shadow_ray"), ("06", "Box::clip"), ("06", "Sphere::overlaps"), ("08", "refract"))


@pytest.fixture(autouse=True)
def _closed_steps(kit: BuiltKit) -> None:
    if kit.description.seal is None:
        pytest.skip("steps are libraries on Linux only")


def _without(kit: BuiltKit, step: Step, function: str, old: str = "", new: str = "") -> str:
    """The solution with a function as the stub has it, and a change."""
    solution = (kit.project.solutions / step.path).read_text(encoding="utf-8")
    source = make_stub(solution, step, [name for name in step.functions if name != function])
    assert old in source
    return source.replace(old, new)


def _graded(
    kit: BuiltKit, step: Step, source: str, folder: Path, feedback: Literal["full", "diagnosis"] = "diagnosis"
) -> StepResult:
    submission = Submission("half", {step.id: source.encode()}, {})
    settings = Settings(seed=_SEED, only=(step.id,), feedback=feedback)
    return grade_submission(kit, submission, settings, LimitsOnly(), folder).steps[0]


def _assert_costs_itself_only(kit: BuiltKit, step: Step, function: str, result: StepResult) -> None:
    shares = {item.name: item.share for item in result.hidden if item.kind == "function"}
    assert shares == {name: 0.0 if name == function else 1.0 for name in step.functions}, f"seed {_SEED}"
    failed = [test.name for test in result.tests if not test.passed]
    tests = kit.tests[step.id]
    assert failed, "a stub passes no test of its own"
    passed = {test.name for test in result.tests if test.passed}
    assert still_missing([function], tests, passed) == [function], "whatever it passes by luck"
    assert [name for name in failed if function not in tests[name]] == []
    assert 0 < result.points < result.max


@pytest.mark.parametrize(
    ("number", "tree", "of"), [("06", "octree", "const Node& root"), ("09", "bvh", "const Bvh& bvh")]
)
def test_a_search_may_call_one_that_is_not_written(
    kit: BuiltKit, number: str, tree: str, of: str, tmp_path: Path
) -> None:
    """It asks no surface itself: those count that are asked for it."""
    step = next(step for step in kit.steps if step.number == number)
    head = f"bool occluded_in_{tree}({of}, const Ray& ray, float distance) {{\n"
    call = f"const auto met = closest_hit_in_{tree}({of.split()[-1]}, ray);\nreturn met && met->distance < distance;\n"
    result = _graded(kit, step, _without(kit, step, f"closest_hit_in_{tree}", head, head + call), tmp_path)
    (found,) = (item for item in result.hidden if item.name == f"occluded_in_{tree}")
    wrong = {group.name for group in found.groups if group.right < group.cases}
    assert wrong <= {"few surfaces are asked", "the first hit ends the search"}, found.message


@pytest.mark.parametrize(("number", "function"), _IN_A_BOX)
def test_it_costs_its_own_points_only(kit: BuiltKit, number: str, function: str, tmp_path: Path) -> None:
    step = next(step for step in kit.steps if step.number == number)
    result = _graded(kit, step, _without(kit, step, function), tmp_path)
    _assert_costs_itself_only(kit, step, function, result)
    assert f"Not written yet: {function}." in result.messages
    assert "Your functions after it are tried with the reference's in its place." in result.messages


@pytest.mark.slow
def test_so_does_every_function_of_every_step(kit: BuiltKit, tmp_path: Path) -> None:
    """Without boxes, which are several times as slow."""
    own = kit.in_one_process()
    jobs = [(step, name) for step in kit.steps for name in step.functions]

    def grade(job: tuple[Step, str]) -> StepResult:
        step, function = job
        name = f"{step.number}-{function.replace('::', '-')}"
        return _graded(own, step, _without(kit, step, function), tmp_path / name)

    with ThreadPoolExecutor(2) as pool:
        results = list(pool.map(grade, jobs))
    assert len(results) > 2 * len(kit.steps)
    for (step, function), result in zip(jobs, results, strict=True):
        _assert_costs_itself_only(kit, step, function, result)


def test_what_is_wrong_is_wrong_all_the_same(kit: BuiltKit, tmp_path: Path) -> None:
    step = next(step for step in kit.steps if step.number == "04")
    call = "const Ray ray = shadow_ray(hit, light);"
    result = _graded(kit, step, _without(kit, step, "shadow_ray", call, f"{call}\n    return true;"), tmp_path)
    judged = next(item for item in result.hidden if item.name == "is_lit")
    assert not judged.passed
    assert not judged.waits_for, "nothing is missing that it needs"
    failed = [test for test in result.tests if not test.passed and not test.waits_for]
    assert failed
    assert {name for test in failed for name in kit.tests[step.id][test.name]} == {"is_lit"}


def test_one_that_is_wrong_costs_its_own_hidden_points_only(kit: BuiltKit, tmp_path: Path) -> None:
    """In a file whose searches ask Box::hit."""
    step = next(step for step in kit.steps if step.number == "06")
    source = (Path(__file__).parents[1] / "diagnosis" / "held_out" / f"{step.id}.cpp").read_text(encoding="utf-8")
    old = "if (a > b) std::swap(a, b);"
    assert source.count(old) == 1
    result = _graded(kit, step, source.replace(old, ""), tmp_path)
    shares = {item.name: item.share for item in result.hidden if item.kind == "function"}
    assert 0 < shares.pop("Box::clip") < 1
    assert set(shares.values()) == {1.0}, "by themselves they are right"
    assert any("with the reference's functions in place" in message for message in result.messages)
    failed = {name for test in result.tests if not test.passed for name in kit.tests[step.id][test.name]}
    assert "closest_hit_in_octree" in failed, "the visible tests try the step as it is"


def _two_wrong(kit: BuiltKit, solved: Sources) -> tuple[Step, str]:
    """Each by itself."""
    step = next(step for step in kit.steps if step.number == "03")
    source = solved[step.id]
    mirrored, weighed = "return direction - 2.0F", "return fill.kd * cosine"
    for old, new in ((mirrored, "return -direction + 2.0F"), (weighed, "return cosine")):
        assert source.count(old) == 1
        source = source.replace(old, new)
    return step, source


def test_two_that_are_wrong_both_cost_theirs(kit: BuiltKit, solved: Sources, tmp_path: Path) -> None:
    step, source = _two_wrong(kit, solved)
    result = _graded(kit.in_one_process(), step, source, tmp_path)
    right = {item.name: item.passed for item in result.hidden if item.kind == "function"}
    assert right == {"mirror": False, "diffuse": False, "specular": True, "shade": True}


def test_the_case_to_replay_is_the_one_that_is_shown(
    kit: BuiltKit, solved: Sources, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the time for examples is over after the first asking, too."""
    step, source = _two_wrong(kit, solved)
    made: list[str] = []
    smallest = Counterexamples.smallest

    def spend(examples: Counterexamples, of: Step, found: JudgedCase, place: int, seed: int) -> tuple[JudgedCase, str]:
        made.append(found.case.function)
        if len(made) > 2:
            examples.budget.left = 0.0
        return smallest(examples, of, found, place, seed)

    monkeypatch.setattr(Counterexamples, "smallest", spend)
    result = _graded(kit.in_one_process(), step, source, tmp_path, "full")
    shown = [item for item in result.hidden if item.case]
    assert {"mirror", "diffuse"} <= {item.name for item in shown}
    for item in shown:
        case = read_case(tmp_path / item.case)
        assert (case.given, case.expected, case.actual) == (item.given, item.expected, item.actual), item.name
    assert made.count("diffuse") == 1, "no better, so the first stays"


def test_to_be_asked_again_costs_no_time_of_the_submission(
    kit: BuiltKit, solved: Sources, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    step, source = _two_wrong(kit, solved)
    accounts: list[list[Task]] = []

    class Account(AccountingSandbox):
        def __init__(self, sandbox: Sandbox, seconds: float) -> None:
            super().__init__(sandbox, seconds)
            self.tasks: list[Task] = []
            accounts.append(self.tasks)

        def run(self, task: Task) -> TaskResult:
            self.tasks.append(task)
            return super().run(task)

    monkeypatch.setattr(pipeline, "AccountingSandbox", Account)
    _graded(kit.in_one_process(), step, source, tmp_path / "again")
    monkeypatch.setattr(HiddenStepGrader, "_ask_apart", lambda *_: None)
    _graded(kit.in_one_process(), step, source, tmp_path / "once")
    again, apart, once, nothing = map(len, accounts)
    assert again == once
    assert apart > 0
    assert nothing == 0


def test_a_test_that_needs_what_is_not_written_says_nothing_of_the_others(kit: BuiltKit) -> None:
    step = next(step for step in kit.steps if step.number == "07")
    tests = {"a": ["tone_map"], "b": ["to_byte"], "both": ["tone_map", "to_byte"]}
    assert weights_of(step, tests, []) == {"a": 0.25, "b": 0.25, "both": 0.5}
    assert weights_of(step, tests, ["to_byte"]) == {"a": 0.5, "b": 0.25, "both": 0.25}
    only_both = {"both": ["tone_map", "to_byte"], "b": ["to_byte"]}
    assert weights_of(step, only_both, ["to_byte"]) == {"both": 0.75, "b": 0.25}, "it has no test of its own"


def test_a_line_that_was_put_in_where_a_function_is_right_moves_no_weight() -> None:
    tests = {"a": ["tone_map"], "b": ["to_byte"], "both": ["tone_map", "to_byte"]}
    assert still_missing(["to_byte"], tests, {"b"}) == []
    assert still_missing(["to_byte"], tests, {"a", "both"}) == ["to_byte"]
    assert still_missing(["to_byte", "tone_map"], tests, {"b"}) == ["tone_map"]
    assert still_missing(["to_byte"], {"both": tests["both"]}, {"both"}) == [], "it has no test of its own"
    assert still_missing(["to_byte"], {"both": tests["both"]}, set()) == ["to_byte"]


def test_nor_does_one_where_a_test_is_failed_on_purpose() -> None:
    own = {f"own {number}": ["to_byte"] for number in range(4)}
    tests = {**own, "both": ["tone_map", "to_byte"]}
    assert still_missing(["to_byte"], tests, {"own 0", "own 1", "own 2"}) == []
    assert still_missing(["to_byte"], tests, {"own 0", "own 1"}) == []
    assert still_missing(["to_byte"], tests, {"own 0", "both"}) == ["to_byte"], "a stub that is right by luck"
    for share, missing in ((0.5, []), (0.4, ["to_byte"])):
        hidden = [HiddenResult("to_byte", "function", share), HiddenResult("to_byte", "picture", 1.0)]
        assert still_missing(["to_byte"], tests, (), hidden) == missing


def test_such_a_box_holds_no_reference(kit: BuiltKit, tmp_path: Path) -> None:
    step = next(step for step in kit.steps if step.number == "04")
    linker = kit.boxes([step])
    assert linker is not None
    names = kit.linker_names(step, ["shadow_ray"])
    assert len(names) == 1
    pieces = reference_code(kit)
    assert any(name.startswith("04 ") for name in pieces)
    home = linker.home("worker", ["04"], tmp_path, names).read_bytes()
    assert any(piece in home for name, piece in pieces.items() if "shadow_ray" in name), "what is looked for is there"
    box = linker.box(["04"], tmp_path, names).read_bytes()
    assert [name for name, piece in pieces.items() if piece in box] == []


def test_what_is_not_written_does_no_work_of_what_it_is_made_of(kit: BuiltKit, tmp_path: Path) -> None:
    """A direction is mirrored by whoever follows a ray: the ray that the reference asks for tells it."""
    step = next(step for step in kit.steps if step.number == "05")
    spy = """
        struct Spy final : Tracer {
            explicit Spy(const HitRecord& hit) : mirror_there(hit) { mirror_there.fill.ks = 1.0F; }
            std::optional<HitRecord> closest_hit(const Ray&) const override { return mirror_there; }
            bool occluded(const Ray&, float) const override { return false; }
            Color direct_lighting(const HitRecord&, int) override { return k_black; }
            Color trace(const Ray& ray, int) override { return seen = ray, k_black; }
            int max_ray_depth() const override { return 2; }
            Color background() const override { return k_black; }
            HitRecord mirror_there;
            Ray seen;
        } spy(hit);
        static_cast<void>(trace(spy, Ray{hit.position, hit.ray_direction}, 1));
        return spy.seen;
    """
    head = "Ray reflected_ray(const HitRecord& hit) {\n"
    result = _graded(kit, step, _without(kit, step, "trace", head, head + spy), tmp_path)
    assert result.points == 0
    assert result.status == "failed"
    asked = {item.name: item.share for item in result.hidden if item.kind == "function"}
    assert asked == {"reflected_ray": 0.0, "trace": 0.0}
