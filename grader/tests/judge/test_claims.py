"""Who is accused of a false claim: forgers, and nobody else."""

from collections.abc import Mapping
from dataclasses import replace

import pytest

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.judge.claims import contradictions
from raysteps.judge.hidden_scenes import twin_name
from raysteps.judge.plan import Plan, read_plan
from raysteps.results.model import CaseGroup, HiddenResult, ImageResult, StepResult, Termination, TestResult
from raysteps.toolchain.kit_artifacts import BuiltKit

_TAGS = {
    "sphere, whole": frozenset({"02-intersection", "Sphere::intersect"}),
    "sphere, part": frozenset({"02-intersection", "Sphere::intersect", "part"}),
    "sphere, miss": frozenset({"02-intersection", "Sphere::intersect", "part"}),
    "closest, any": frozenset({"02-intersection", "closest_hit", "any"}),
    "both": frozenset({"02-intersection", "closest_hit", "Sphere::intersect", "any"}),
}


@pytest.fixture(scope="module")
def step(steps: list[Step]) -> Step:
    return next(step for step in steps if step.number == "02")


@pytest.fixture(scope="module")
def plan(project: Project, step: Step) -> Plan:
    plan = read_plan(project, step)
    assert plan is not None
    return plan


def _seen(plan: Plan, name: str, shares: Mapping[str, float], outcome: Termination = "wrong") -> HiddenResult:
    """What share of each kind of cases came out right; 0 where nothing is said."""
    cases = next(function.cases for function in plan.functions if function.name == name)
    assert set(shares) <= set(cases)
    groups = [CaseGroup(kind, count, round(shares.get(kind, 0) * count)) for kind, count in cases.items()]
    return HiddenResult(name, "function", 0.0, groups=groups, outcome=outcome)


def _result(passed: set[str], hidden: list[HiddenResult]) -> StepResult:
    result = StepResult("02-intersection", "partial", 0, 20, False)
    result.tests = [TestResult(name, name in passed) for name in _TAGS]
    result.hidden = hidden
    return result


_MISSES = {"behind the origin": 1.0, "passed by": 1.0, "hit or missed from outside": 0.3}
_NOTHING = {"all missed": 1.0, "no surfaces": 1.0}


def test_a_forged_report_of_a_stub(step: Step, plan: Plan) -> None:
    hidden = [_seen(plan, "Sphere::intersect", _MISSES), _seen(plan, "closest_hit", _NOTHING)]
    result = _result(set(_TAGS), hidden)
    lines = contradictions(step, plan, result, _TAGS)
    assert len(lines) == len(_TAGS)
    assert not any(test.passed for test in result.tests)
    assert all(test.outcome == "wrong" and "does not count" in test.message for test in result.tests)


def test_a_forger_who_lets_one_test_fail(step: Step, plan: Plan) -> None:
    hidden = [_seen(plan, "Sphere::intersect", _MISSES), _seen(plan, "closest_hit", _NOTHING)]
    result = _result({"sphere, whole", "sphere, part", "closest, any", "both"}, hidden)
    contradictions(step, plan, result, _TAGS)
    assert {test.name for test in result.tests if test.passed} == {"sphere, part"}


def test_honest_and_right(step: Step, plan: Plan) -> None:
    names = ("Sphere::intersect", "closest_hit")
    full = [
        _seen(plan, n, dict.fromkeys(next(f.cases for f in plan.functions if f.name == n), 1.0), "ok") for n in names
    ]
    result = _result(set(_TAGS), full)
    assert contradictions(step, plan, result, _TAGS) == []
    assert all(test.passed for test in result.tests)


@pytest.mark.parametrize(
    ("passed", "sphere", "closest"),
    [
        # The stub, honestly reported: it misses everything, and so passes a test of misses.
        ({"sphere, miss"}, _MISSES, _NOTHING),
        # The centre is forgotten: a sphere at the centre of the world comes out right, half of the simple cases.
        ({"sphere, whole", "sphere, part", "sphere, miss"}, {**_MISSES, "simple numbers": 0.5}, {"several hits": 1.0}),
        # The fill is forgotten: every hit is wrong, and tests of distance and normal pass.
        ({"sphere, part", "sphere, miss"}, _MISSES, {"several hits": 1.0}),
        # The origin inside is missed: one kind of cases.
        (set(_TAGS), {"hit or missed from outside": 1.0, "simple numbers": 1.0}, {"several hits": 1.0}),
        # The search takes the first hit: right where it is the nearest.
        ({"sphere, miss", "closest, any"}, _MISSES, {"several hits": 0.5, "a single surface": 1.0}),
        # closest_hit is a stub, and a test of both functions passes by way of the good one.
        ({"both"}, {"hit or missed from outside": 1.0}, _NOTHING),
    ],
)
def test_honest_mistakes(
    step: Step, plan: Plan, passed: set[str], sphere: Mapping[str, float], closest: Mapping[str, float]
) -> None:
    result = _result(passed, [_seen(plan, "Sphere::intersect", sphere), _seen(plan, "closest_hit", closest)])
    assert contradictions(step, plan, result, _TAGS) == []
    assert {test.name for test in result.tests if test.passed} == passed


def _cut_short(plan: Plan, name: str, asked: int, right: int, outcome: Termination) -> HiddenResult:
    """The first ordinary cases were asked, and then no more."""
    result = _seen(plan, name, {}, outcome)
    for place, group in enumerate(result.groups):
        group.undecided = group.cases if place else group.cases - asked
    result.groups[0].right = right
    return result


@pytest.mark.parametrize("outcome", ["crashed", "timeout", "wrong"])
def test_what_was_never_asked_speaks_against_nobody(step: Step, plan: Plan, outcome: Termination) -> None:
    """Four rare crashes, or no time at all; or the answers were too large."""
    for asked, right in ((0, 0), (12, 8), (8, 4)):
        hidden = [_cut_short(plan, name, asked, right, outcome) for name in ("Sphere::intersect", "closest_hit")]
        result = _result(set(_TAGS), hidden)
        assert contradictions(step, plan, result, _TAGS) == []
        assert all(test.passed for test in result.tests)


@pytest.mark.parametrize(("asked", "right"), [(1, 0), (4, 0), (9, 4)])
def test_a_crash_on_purpose_is_no_way_out(step: Step, plan: Plan, asked: int, right: int) -> None:
    hidden = [_cut_short(plan, name, asked, right, "timeout") for name in ("Sphere::intersect", "closest_hit")]
    result = _result(set(_TAGS), hidden)
    assert len(contradictions(step, plan, result, _TAGS)) == len(_TAGS)


def test_after_a_crash_nobody_knows_the_rest(step: Step, plan: Plan) -> None:
    hidden = [_seen(plan, "Sphere::intersect", {}, "crashed")]
    result = _result({"sphere, whole"}, hidden)
    assert contradictions(step, plan, result, _TAGS) == []


def test_a_test_without_tags_is_believed(step: Step, plan: Plan) -> None:
    result = _result(set(_TAGS), [_seen(plan, "Sphere::intersect", {}), _seen(plan, "closest_hit", {})])
    assert contradictions(step, plan, result, {}) == []


@pytest.mark.parametrize(
    ("wrong_share", "accused"), [(0.0, False), (0.02, False), (0.055, False), (0.3, True), (1.0, True), (None, False)]
)
def test_an_embedded_picture(step: Step, plan: Plan, wrong_share: float | None, accused: bool) -> None:
    image = step.images[0]
    result = StepResult("02-intersection", "partial", 0, 20, False)
    result.images = [ImageResult(image.name, image.scene, True, image.max_wrong)]
    result.hidden = [HiddenResult(twin_name(image.name), "picture", 0.0, wrong_share=wrong_share)]
    lines = contradictions(step, plan, result, {})
    assert bool(lines) == accused
    assert result.images[0].passed is not accused


def _shared(
    octree: Step, plan: Plan, wrong: Mapping[str, int], *, wasteful: bool, outcome: Termination = "wrong"
) -> tuple[list[str], StepResult]:
    """Step 06 whose pictures all pass, after so many cases of these kinds were wrong."""
    result = StepResult(octree.id, "partial", 0, 20, False)
    result.images = [ImageResult(image.name, image.scene, True, image.max_wrong) for image in octree.images]
    for function in plan.functions:
        groups = [
            CaseGroup(kind, n, n - wrong.get(kind, 0), 0, wrong.get(kind, 0) if wasteful else 0)
            for kind, n in function.cases.items()
        ]
        bad = any(group.right < group.cases for group in groups)
        ending: Termination = outcome if bad else "ok"
        result.hidden.append(HiddenResult(function.name, "function", 0.5, groups=groups, outcome=ending))
    result.hidden += [HiddenResult(twin_name(image.name), "picture", 1.0) for image in octree.images]
    result.hidden += [HiddenResult(scene.name, "picture", 1.0) for scene in plan.random_scenes]
    return contradictions(octree, plan, result, {}), result


@pytest.mark.parametrize("kind", ["many small spheres", "few surfaces are asked"])
def test_who_spares_nothing(project: Project, steps: list[Step], kind: str) -> None:
    """All cases wasteful: the claims fall. All lost or crashed, or some wasteful: nobody is accused."""
    octree = next(step for step in steps if step.number == "06")
    plan = read_plan(project, octree)
    assert plan is not None
    amount = next(function.cases[kind] for function in plan.functions if kind in function.cases)
    for outcome in ("wrong", "crashed"):  # a crash on purpose in another kind is no way out
        lines, result = _shared(octree, plan, {kind: amount}, wasteful=True, outcome=outcome)
        assert len(lines) == len(octree.images)
        assert not any(image.passed for image in result.images)
        assert not any(item.share for item in result.hidden if item.kind == "picture")
    assert _shared(octree, plan, {kind: amount}, wasteful=False)[0] == []
    assert _shared(octree, plan, {kind: amount - 1}, wasteful=True)[0] == []


@pytest.mark.parametrize(("shares", "kept"), [((0.9, 0.3), 1), ((0.9, 0.01), 0), ((0.4, 0.3), 0)])
def test_who_owns_up_to_the_work(project: Project, steps: list[Step], shares: tuple[float, float], kept: int) -> None:
    """In one picture the rays tested too much by the program's own count: then the other one may be mostly sky."""
    octree = next(step for step in steps if step.number == "06")
    plan = read_plan(project, octree)
    assert plan is not None
    function = next(function for function in plan.functions if function.name == "build_octree")
    groups = [CaseGroup(kind, n, 0, 0, n) for kind, n in function.cases.items()]
    result = StepResult(octree.id, "partial", 0, 20, False)
    result.images = [
        ImageResult(image.name, image.scene, share <= 0.6, image.max_wrong, max_share=0.6, share_tested=share)
        for image, share in zip(octree.images, shares, strict=False)
    ]
    result.hidden = [HiddenResult(function.name, "function", 0.5, groups=groups, outcome="wrong")]
    contradictions(octree, plan, result, {})
    assert sum(image.passed for image in result.images) == kept


def test_only_pictures_with_a_share_fall(project: Project, steps: list[Step]) -> None:
    octree = next(step for step in steps if step.number == "06")
    plan = read_plan(project, octree)
    assert plan is not None
    first = replace(octree.images[0], max_share=None)
    octree = replace(octree, images=(first, *octree.images[1:]))
    plan = replace(plan, random_scenes=tuple(replace(scene, max_share=None) for scene in plan.random_scenes))
    _, result = _shared(octree, plan, {"many small spheres": 5}, wasteful=True)
    assert [image.name for image in result.images if image.passed] == [first.name]
    kept = {item.name for item in result.hidden if item.kind == "picture" and item.share}
    assert kept == {twin_name(first.name), *(scene.name for scene in plan.random_scenes)}


def test_every_visible_test_names_functions_of_its_step(kit: BuiltKit) -> None:
    for step in kit.steps:
        asked: set[str] = set()
        for name, tags in kit.tests[step.id].items():
            functions = tags & set(step.functions)
            assert functions, f"{name}: tag it with the function that it tests"
            assert tags - functions <= {step.id, "any", "part"}, name
            asked |= functions
        assert asked == set(step.functions), step.id
