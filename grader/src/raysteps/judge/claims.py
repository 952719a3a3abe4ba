"""A visible test that claims to pass counts only when the judge saw the same.

The program under test reports on itself, so it could report anything. The judge's cases come from outside. A claim is
a contradiction only where no honest program makes it, however many mistakes it has:

- all tests of a function pass, but of its ordinary cases less than half are right. The tests together ask for
  everything, in hundreds of inputs;
- a test tagged [any] passes, but less than half are right: it alone asks for the whole answer to any input;
- a test without a mark passes, but of all cases that take a real answer not one is right. It asks for the whole answer
  to a few inputs, and these may come out right where most others do not;
- a test tagged [part] proves nothing alone: it asks for a part of the answer, or a function hardly begun passes it;
- a picture passes, but its twin is grossly wrong;
- a picture says that few objects were tested, but the tree or the search spares the rays nothing.

Of the cases only those count in which the judge saw what the function does: it was asked, and its answer could be read.
A case in which it crashed or hung is one of them, so that silence is no way out.

Where a test asks for several functions, all of them must speak against it.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from raysteps.common.text import join_and
from raysteps.course.manifest import Step
from raysteps.judge.functions import Function, functions_of
from raysteps.judge.hidden_scenes import twin_name
from raysteps.judge.plan import Plan
from raysteps.results.model import HiddenResult, ImageResult, StepResult, TestResult

# A claim that few objects were tested counts only when the judge saw how the rays were spared. How many were tested
# is counted in the program itself. The judge looks at the tree that the program hands out, and counts by surfaces of
# its own.

MESSAGE = "The program says that this passes, but the judge's own inputs say otherwise; it does not count."
_MAX = 0.5
_TOO_GOOD = 0.25  # of what is allowed: not even rays into the empty sky make it so little


def _saves_nothing(result: HiddenResult, function: Function) -> bool:
    """No case of a kind is right, and most are not because they spare no work: another mistake is no such claim."""
    groups = [group for group in result.groups if function.by_name[group.name].saves]
    return any(not group.right and group.wasteful > _MAX * group.decided for group in groups)


def _with_limit(step: Step, plan: Plan) -> tuple[set[str], set[str]]:
    """The visible pictures and the hidden ones in which few objects may be tested."""
    visible = {image.name for image in step.images if image.max_share is not None}
    made_up = {scene.name for scene in plan.random_scenes if scene.max_share is not None}
    return visible, made_up | {twin_name(name) for name in visible}


def _owns_up(image: ImageResult) -> bool:
    """Whether the program itself says that its rays tested too much."""
    most = image.max_share
    return most is not None and image.share_tested is not None and image.share_tested > most


def false_work_claims(
    step: Step, plan: Plan, images: Sequence[ImageResult], hidden: Sequence[HiddenResult]
) -> list[str]:
    """Takes back what nobody saw, and says so, one line for each visible picture. Where most of a picture is sky, few
    objects are tested without any merit: so a program that owns up to its work in one picture is believed in others."""
    known = functions_of(step.number)
    wasteful = [item.name for item in hidden if item.kind == "function" and _saves_nothing(item, known[item.name])]
    if not wasteful:
        return []
    limited, limited_hidden = _with_limit(step, plan)
    honest = any(_owns_up(image) for image in images)
    lines = []
    for image in images:
        too_good = (image.share_tested or 0) < _TOO_GOOD * (image.max_share or 1)
        if image.passed and image.name in limited and (too_good or not honest):
            lines.append(
                f"The picture '{image.name}' claims that {image.share_tested or 0:.1%} of the objects were tested, but "
                f"the judge found that {join_and(wasteful)} spares the rays nothing."
            )
            image.passed, image.outcome, image.message = False, "wrong", MESSAGE
    for item in hidden:
        if item.kind == "picture" and item.share > 0 and item.name in limited_hidden and not honest:
            item.share, item.outcome, item.message = 0.0, "wrong", MESSAGE
    return lines


ANY = "any"
PART = "part"
_HALF = 0.5
_GROSSLY = 10  # times what the twin's gate allows
_GROSS_SHARE = 0.1

Tags = Mapping[str, frozenset[str]]


@dataclass(frozen=True)
class _Seen:
    """What the judge saw of one function, and whether all its visible tests claim to pass."""

    function: Function
    result: HiddenResult
    all_claimed: bool

    def mostly_wrong(self) -> bool:
        """Of the ordinary cases that were decided less than half are right."""
        groups = self.result.groups
        return bool(groups) and groups[0].right < _HALF * groups[0].decided

    def wholly_wrong(self) -> bool:
        """Not one case is right of those that take a real answer; of yes and no, some always are. Where the worker
        ended early, nobody knows what the rest would have been."""
        if self.result.outcome != "wrong":
            return False
        if self.function.yes_or_no:
            return self.mostly_wrong()
        telling = [group for group in self.result.groups if self.function.by_name[group.name].telling]
        return bool(telling) and not any(group.right or group.undecided for group in telling)

    def denied(self) -> bool:
        """All its tests together claim more than the judge saw."""
        return self.all_claimed and self.mostly_wrong()


def _look(step: Step, tests: Sequence[TestResult], hidden: Sequence[HiddenResult], tags: Tags) -> dict[str, _Seen]:
    known = functions_of(step.number)
    seen = {}
    for item in hidden:
        if item.kind == "function" and item.name in known:
            mine = [test.passed for test in tests if item.name in tags.get(test.name, frozenset())]
            seen[item.name] = _Seen(known[item.name], item, len(mine) > 1 and all(mine))
    return seen


def _speaks_against(marks: frozenset[str]) -> Callable[[_Seen], bool]:
    """When a function alone speaks against a test with these tags."""
    if ANY in marks:
        return _Seen.mostly_wrong
    return _Seen.denied if PART in marks else _Seen.wholly_wrong


def _tests(step: Step, result: StepResult, tags: Tags) -> list[str]:
    seen = _look(step, result.tests, result.hidden, tags)
    lines = []
    for test in result.tests:
        marks = tags.get(test.name, frozenset())
        names = sorted(name for name in marks if name in seen)
        against = _speaks_against(marks)
        if test.passed and names and all(against(seen[name]) or seen[name].denied() for name in names):
            lines.append(
                f"The test '{test.name}' claims to pass, but most of the judge's ordinary cases of {join_and(names)} "
                "came out wrong."
            )
            test.passed, test.outcome, test.message = False, "wrong", MESSAGE
    return lines


def _images(plan: Plan, images: Sequence[ImageResult], hidden: Sequence[HiddenResult]) -> list[str]:
    seen = {item.name: item for item in hidden if item.kind == "picture"}
    gates = {twin.twin_of: twin.max_wrong for twin in plan.twins}
    lines = []
    for image in images:
        twin = seen.get(twin_name(image.name))
        if not image.passed or twin is None or twin.wrong_share is None or image.name not in gates:
            continue
        if twin.wrong_share > max(_GROSS_SHARE, _GROSSLY * gates[image.name]):
            lines.append(
                f"The picture '{image.name}' is right, but the same scene seen from a little farther round is "
                "grossly wrong."
            )
            image.passed, image.outcome, image.message = False, "wrong", MESSAGE
    return lines


def contradictions(step: Step, plan: Plan, result: StepResult, tags: Tags) -> list[str]:
    """Takes back the claims that the judge did not see, and says so for the instructor, one line each."""
    lines = _tests(step, result, tags) + _images(plan, result.images, result.hidden)
    return lines + false_work_claims(step, plan, result.images, result.hidden)
