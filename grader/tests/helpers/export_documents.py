"""Hand-made results for the tests of the exports."""

from raysteps.course.manifest import Step
from raysteps.results.model import (
    CaseGroup,
    HiddenResult,
    ImageResult,
    Integration,
    Results,
    StepResult,
    TestResult,
    Timing,
    Work,
)
from raysteps.results.store import validate

HOSTILE = "<script>alert(1)</script>\x1b[31m\x00\u202eevil\n::error::done\nfine ##[error]done"


def step_result(step: Step, *, share: float = 1.0, text: str = "is wrong") -> StepResult:
    """A step in which the first checks of each kind passed, up to that share, graded as the grader does it."""
    result = StepResult(step.id, "passed", step.points, step.points, step.bonus)
    for at in range(7):
        good = at < round(7 * share)
        said = ("",) * 4 if good else (text, "a == b", "1 == 2", "a.cpp:7")
        result.tests.append(TestResult(f"test {at}", good, *said, outcome="ok" if good else "wrong"))
    for at, case in enumerate(step.images):
        good = at < round(len(step.images) * share)
        image = ImageResult(case.name, case.scene, good, case.max_wrong, 0.0 if good else 0.5, case.max_share)
        image.message = "" if good else text
        if case.max_share is not None:
            image.share_tested = 0.01 * (at + 1)
            image.work, image.reference_work = Work(100, 500, 1500, 9, 20, 4000), Work(100, 300, 700, 9, 20, 3000)
        result.images.append(image)
    for at in range(3):
        hidden = HiddenResult(f"function {at}", "function", 1.0 if share >= 1 else share * at / 2, weight=at + 1.0)
        hidden.groups = [CaseGroup("origin inside", 20, round(20 * hidden.share))]
        if not hidden.passed:
            hidden.message, hidden.outcome = text, "wrong"
            hidden.given, hidden.expected, hidden.actual = "secret input", "secret answer", "its answer"
        result.hidden.append(hidden)
    if share < 1:
        tests = sum(test.passed for test in result.tests) / 7
        images = sum(image.passed for image in result.images) / len(result.images)
        asked = sum(item.share * item.weight for item in result.hidden) / 6
        shares = step.weight_tests * tests + step.weight_images * images + step.weight_hidden * asked
        result.points = round(step.points * shares, 2)
        result.status = "partial" if result.points else "failed"
        result.messages = ["Some of 7 tests failed.", text]
    result.cumulative = Integration(share >= 1, "" if share >= 1 else "balls: the picture is wrong.")
    return result


def document(results: list[StepResult], name: str = "ann") -> Results:
    """As `grade` makes them."""
    made = Results.of(name, results, kit="abc123", timing=Timing(12.4, 20.0))
    validate(made)
    return made


def mixed(steps: list[Step], text: str = "is wrong") -> Results:
    """Some steps right, some in part, one that does not build, and one that was not started."""
    results = [step_result(step, share=1.0 if step.index in (1, 6) else 0.37, text=text) for step in steps]
    results[6] = StepResult(steps[6].id, "does-not-build", 0.0, steps[6].points, False, build_log=text)
    results[6].messages = [f"It does not build: {text}"]
    results[7] = StepResult(steps[7].id, "not-started", 0.0, steps[7].points, True, messages=["Not handed in."])
    return document(results)


def full(steps: list[Step]) -> Results:
    return document([step_result(step) for step in steps])
