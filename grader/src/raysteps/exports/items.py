"""The checks of a step as a list: what each was, how much of it was right, and what to say about it."""

import html
import re
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from raysteps.common.text import apportion, clean, count, shorten, tenths
from raysteps.course.manifest import Step
from raysteps.report.wording import hand_in_words, review_lines, total_words
from raysteps.results.model import Diagnosis, HiddenResult, ImageResult, Integration, Results, StepResult, TestResult

# Makes text that came from a student's program safe to show somewhere else.


def one_line(text: str, limit: int = 200) -> str:
    """For names and titles."""
    return shorten(" ".join(clean(text, limit * 4).split()), limit)


def as_html(text: str, limit: int = 4000) -> str:
    """For places that render HTML."""
    return html.escape(clean(text, limit)).replace("\n", "<br>")


def as_code(text: str, limit: int = 60_000) -> str:
    """For places that render Markdown: a block of code, whose fence is longer than any in the text."""
    said = clean(text, limit)
    fence = "`" * max(3, 1 + max(map(len, re.findall("`+", said)), default=0))
    return f"{fence}text\n{said}\n{fence}\n"


def wrapped(text: str) -> str:
    """For places that show lines as they are, and cut off what is longer; a line goes on where it was indented to."""
    lines = []
    for line in text.splitlines():
        indent = line[: len(line) - len(line.lstrip())] + ("    " if line.lstrip().startswith("- ") else "")
        parts = textwrap.wrap(line, 96, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
        lines += parts or [""]
    return "\n".join(lines)


Kind = Literal["test", "picture", "hidden", "together", "step"]


@dataclass(frozen=True)
class Item:
    """One check. `inputs` is what a hidden check must not show."""

    kind: Kind
    name: str
    weight: float
    share: float
    text: str
    inputs: str = ""
    pictures: tuple[tuple[str, str], ...] = ()  # label, path beside results.json

    @property
    def passed(self) -> bool:
        return self.share >= 1


def _lines(*pairs: tuple[str, str]) -> str:
    return "\n".join(f"{label}{clean(value)}" for label, value in pairs if value)


def _test(test: TestResult, weight: float) -> Item:
    text = _lines(
        ("", test.message),
        ("expected: ", test.expression),
        ("got: ", test.expanded),
        ("see ", test.location),
    )
    name = one_line(test.name)
    return Item("test", name, weight, float(test.passed), "passed" if test.passed else text or "failed")


def _picture(image: ImageResult, weight: float) -> Item:
    wrong = image.wrong_share
    seen = ""
    if wrong is not None and not image.noisy:
        seen = f"{wrong:.2%} of the pixels are wrong; at most {image.max_wrong:.2%} may be."
    text = _lines(("", image.message or seen), ("scene: ", image.scene))
    pictures = (("mine", image.mine), ("reference", image.reference), ("difference", image.difference))
    shown = tuple((kind, path) for kind, path in pictures if path)
    return Item("picture", one_line(image.name), weight, image.earned, text, pictures=shown)


def _hidden(hidden: HiddenResult, weight: float) -> Item:
    groups = [f"{one_line(group.name)}: {group.right} of {count(group.cases, 'case')} right" for group in hidden.groups]
    text = "\n".join([*filter(None, [clean(hidden.message)]), *groups])
    inputs = _lines(("input: ", hidden.given), ("expected: ", hidden.expected), ("got: ", hidden.actual))
    share = float(hidden.share)
    return Item("hidden", one_line(hidden.name), weight, share, text or ("passed" if share >= 1 else "wrong"), inputs)


def _together(cumulative: Integration, weight: float) -> Item:
    passed = cumulative.passed
    text = clean(cumulative.message) or ("passed" if passed else "wrong")
    return Item("together", "with the steps before it", weight, float(passed), text)


def _each(group: float, weights: Sequence[float]) -> list[float]:
    whole = sum(weights)
    return [group * weight / whole if whole else 0.0 for weight in weights]


def items_of(result: StepResult, step: Step | None) -> list[Item]:
    """The checks of one step, weighted as the manifest weights them."""
    tests, images, hidden = result.tests, result.images, result.hidden
    weights = (1.0, 1.0, 1.0, 0.0)
    if step is not None:
        weights = (step.weight_tests, step.weight_images, step.weight_hidden, step.weight_together)
    items = [_test(*pair) for pair in zip(tests, _each(weights[0], [test.weight for test in tests]), strict=True)]
    items += [_picture(*pair) for pair in zip(images, _each(weights[1], [1.0] * len(images)), strict=True)]
    own = [float(item.weight) for item in hidden]
    items += [_hidden(*pair) for pair in zip(hidden, _each(weights[2], own), strict=True)]
    return [*items, _together(result.cumulative, weights[3])] if items and weights[3] else items


def _diagnosis(diagnosis: Diagnosis) -> list[str]:
    """What explains a wrong step: what it is, where it comes from and what to ask, a line each."""
    title = one_line(diagnosis.title, 600)
    seen = ", ".join(one_line(name) for name in diagnosis.seen_in)
    hint = f"Hint: {one_line(diagnosis.hint, 600)}" if diagnosis.hint else ""
    if diagnosis.kind == "finding":
        return [title, *filter(None, [hint])]
    others = "".join(f", or when {one_line(other, 600)}" for other in diagnosis.alike)
    where = f"Seen in {seen}." if seen else ""
    said = (f"This is what you get when {title}{others}.", one_line(diagnosis.cause, 600), where, hint)
    return [line for line in said if line]


def step_text(result: StepResult) -> str:
    """What there is to say about a step as a whole."""
    said = [clean(message) for message in result.messages]
    said += [line for diagnosis in result.diagnoses for line in _diagnosis(diagnosis)]
    if result.status == "does-not-build" and result.build_log:
        said.append(clean(result.build_log))
    said += [clean(line) for line in review_lines(result.review)]
    return "\n".join(said)


# Shares a step's points out among its checks, in hundredths, so that the sums come out exactly.


@dataclass(frozen=True)
class ScoredItem:
    """A check with its points."""

    item: Item
    points: float
    most: float


def _hundredths(points: float) -> int:
    return round(points * 100)


def _rest(result: StepResult, items: list[Item], earned: int, lost: int) -> list[Item]:
    """One more entry for what no check accounts for: a step that was not run, or points that an
    older kit weighed otherwise."""
    all_wrong = earned > 0 and not sum(item.weight * item.share for item in items)
    all_right = lost > 0 and not sum(item.weight * (1 - item.share) for item in items)
    if items and not all_wrong and not all_right:
        return []
    share = earned / (earned + lost) if earned + lost else 0.0
    if not items:
        return [Item("step", result.shown.words, 1.0, share, step_text(result))]
    if all_wrong != all_right:
        share = 1.0 if all_wrong else 0.0
    return [Item("step", "the rest", 1.0, share, "Points that no single check accounts for.")]


def entries_of(result: StepResult, step: Step | None) -> list[ScoredItem]:
    """What was earned goes to the checks by what was right in them, what was lost by what was wrong."""
    earned = _hundredths(result.points)
    lost = max(0, _hundredths(result.max) - earned)
    items = items_of(result, step)
    items += _rest(result, items, earned, lost)
    right = [item.weight * item.share for item in items]
    wrong = [item.weight * (1 - item.share) for item in items]
    gains = apportion(earned, right) if earned else [0] * len(items)
    losses = apportion(lost, wrong) if lost else [0] * len(items)
    return [
        ScoredItem(item, gain / 100, (gain + loss) / 100) for item, gain, loss in zip(items, gains, losses, strict=True)
    ]


def extra_of(results: Results) -> float:
    """What a person added to the points of the submission as a whole, as far as the total holds it."""
    return round(results.total.points - sum(step.points for step in results.steps), 2)


WHOLE = "The submission as a whole"


def spread_deduction(results: Results) -> Results:
    """For systems in which no check has less than 0 points: what a person took off the whole is taken off the steps, in
    proportion to their points."""
    lost = -_hundredths(extra_of(results))
    if lost <= 0:
        return results
    shares = apportion(lost, [step.points for step in results.steps])
    steps = [
        replace(step, points=round(step.points - share / 100, 2))
        for step, share in zip(results.steps, shares, strict=True)
    ]
    return replace(results, steps=steps)


# A whole submission in a few lines of text.

_HOW_TO_REPEAT = "to repeat these random inputs, set RAYSTEPS_SEED="  # what a failed test of the kit says first


def title(result: StepResult, steps: Mapping[str, Step]) -> str:
    """`02 Intersection`, as the manifest has it."""
    step = steps.get(result.id)
    name = step.title if step is not None else result.id[3:]
    return f"{result.id[:2]} {name}" + (" (bonus)" if result.bonus else "")


def _visible(result: StepResult) -> str:
    parts = []
    kinds: tuple[tuple[Sequence[TestResult | ImageResult], str], ...] = (
        (result.tests, "test"),
        (result.images, "picture"),
    )
    for items, noun in kinds:
        if items:
            parts.append(f"{sum(item.passed for item in items)} of {count(len(items), noun)} passed")
    return ", ".join(parts) or result.shown.words


def failed_checks(result: StepResult, step: Step | None) -> list[str]:
    """What failed, and why."""
    failed = [(item, _why(item.text)) for item in items_of(result, step) if not item.passed]
    return [f"  - {item.kind} {item.name}: {one_line(why, 300)}" for item, why in failed]


def _why(text: str) -> str:
    """The first line that tells what is wrong; an expression alone does not, without what came of it."""
    lines = [line for line in text.splitlines() if not line.startswith(_HOW_TO_REPEAT)] or ["failed"]
    return ", ".join(lines[:2]) if lines[0].startswith("expected: ") else lines[0]


def _same_for_all(results: Results) -> str:
    """What is said of every step alike, such as that nothing could be read."""
    said = {step_text(result) for result in results.steps}
    return said.pop() if len(said) == 1 and len(results.steps) > 1 else ""


def summary(results: Results, steps: Mapping[str, Step], *, points: bool = True, checks: bool = False) -> str:
    """One line per step with what there is to say about it, on request with the checks that failed; without points,
    nothing that hidden checks decide."""
    lines = [f"{total_words(results.total)}.", *hand_in_words(results)] if points else []
    lines += [one_line(line, 2000) for line in review_lines(results.review, whole=True)] if points else []
    same = _same_for_all(results)
    lines += same.splitlines()
    for result in results.steps:
        name = one_line(title(result, steps))
        if points:
            lines.append(f"{name}: {tenths(result.points)} of {tenths(result.max)}, {result.shown.words}")
        else:
            lines.append(f"{name}: {_visible(result)}")
        if not same and (points or result.status in ("not-started", "does-not-build")):
            lines += [f"  {line}" for line in step_text(result).splitlines()]
        if checks:
            lines += failed_checks(result, steps.get(result.id))
    return "\n".join(lines)


def objects_tested(results: Results) -> float | None:
    """Step 06: surfaces tested per ray in percent of the scene's, over its pictures; None unless all are right."""
    images = [image for result in results.steps if result.id[:2] == "06" for image in result.images]
    shares: list[float | None] = [image.share_tested for image in images if image.max_share is not None]
    known = [share for share in shares if share is not None]
    if not known or len(known) < len(shares) or not all(image.passed for image in images):
        return None
    return round(100 * sum(known) / len(known), 3)
