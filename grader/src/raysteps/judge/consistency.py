"""A visible test that claims to pass counts only when the judge saw the same.

The program under test reports on itself, so it could report anything. The judge's cases come from outside. A claim is
a contradiction only where an honest program cannot make it:

- a test of any inputs (tag [any]) passes, but of the ordinary cases of each of its functions less than half are right:
  such a test asks hundreds of inputs of the same kind;
- any other test passes, but of each of its functions not one case is right, of all kinds that take a real answer. One
  example may well come out right where the function is wrong for most inputs, so nothing less is a contradiction;
- a test of an edge (tag [edge]) is never one: a function that is hardly begun may pass it;
- a picture passes, but its twin is grossly wrong.
"""

from collections.abc import Mapping, Sequence

from raysteps.common.text import listed
from raysteps.grading.results import HiddenResult, ImageResult, StepResult, TestResult
from raysteps.judge.functions import Function
from raysteps.judge.generators import functions_of
from raysteps.judge.hidden_scenes import twin_name
from raysteps.judge.plan import Plan
from raysteps.kit.manifest import Step

ANY = "any"
EDGE = "edge"
_HALF = 0.5
_GROSSLY = 10  # times what the twin's gate allows
_GROSS_SHARE = 0.05
_MESSAGE = "The program says that this passes, but the judge's own inputs say otherwise; it does not count."


def _mostly_wrong(result: HiddenResult) -> bool:
    """Of the ordinary cases."""
    return bool(result.groups) and result.groups[0].right < _HALF * result.groups[0].cases


def _wholly_wrong(result: HiddenResult, function: Function) -> bool:
    """In every kind that takes a real answer. Where the worker crashed, nobody knows what the rest would have been."""
    telling = [group for group in result.groups if function.by_name[group.name].telling]
    return bool(telling) and result.outcome == "wrong" and not any(group.right for group in telling)


def _contradicted(
    test: TestResult, tags: frozenset[str], seen: Mapping[str, HiddenResult], known: Mapping[str, Function]
) -> list[str]:
    """The functions that speak against the claim: all of the test's, or none."""
    names = sorted(name for name in tags if name in seen)
    if not test.passed or not names or EDGE in tags:
        return []
    if ANY in tags:
        return names if all(_mostly_wrong(seen[name]) for name in names) else []
    return names if all(_wholly_wrong(seen[name], known[name]) for name in names) else []


def _tests(
    step: Step, tests: Sequence[TestResult], hidden: Sequence[HiddenResult], tags: Mapping[str, frozenset[str]]
) -> list[str]:
    seen = {item.name: item for item in hidden if item.kind == "function"}
    known = functions_of(step.number)
    lines = []
    for test in tests:
        names = _contradicted(test, tags.get(test.name, frozenset()), seen, known)
        if names:
            much = "most" if ANY in tags.get(test.name, frozenset()) else "all"
            lines.append(
                f"The test '{test.name}' claims to pass, but the judge found {much} of the ordinary cases of "
                f"{listed(names)} wrong."
            )
            test.passed, test.outcome, test.message = False, "wrong", _MESSAGE
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
                f"grossly wrong."
            )
            image.passed, image.outcome, image.message = False, "wrong", _MESSAGE
    return lines


def contradictions(step: Step, plan: Plan, result: StepResult, tags: Mapping[str, frozenset[str]]) -> list[str]:
    """Takes back the claims that the judge did not see, and says so for the instructor, one line each."""
    return _tests(step, result.tests, result.hidden, tags) + _images(plan, result.images, result.hidden)
