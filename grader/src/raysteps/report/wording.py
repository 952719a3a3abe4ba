"""Words of a report: commands for its reader to copy, points, and what people said."""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from raysteps.common.platform import kit_command, own_command, quote_command
from raysteps.common.text import number, tenths
from raysteps.course.manifest import ImageCase, Step
from raysteps.course.project import here
from raysteps.results.model import (
    Comment,
    HandIn,
    ImageResult,
    PointsOverride,
    Results,
    Review,
    StepResult,
    Termination,
    TestResult,
    Total,
)
from raysteps.results.statuses import in_words

_OF_INSPECT = ("--step", "--size", "--depth", "--view", "--accel")  # of the arguments that a picture is made with


def check_command(step_id: str) -> str:
    """Checks one's own step."""
    return f"{own_command()} check {step_id[:2]}"


def after_the_last() -> list[tuple[str, str]]:
    """What to try when every step is right: a command that a students' kit has, too, and what it does."""
    return [
        (f"{own_command()} finale", "draws a large picture with all that you have written"),
        (f"{own_command()} view scenes/lessons/three-spheres.nff", "lets you walk through a scene in a window"),
    ]


def watch_command(step_id: str) -> str:
    """Works on a step."""
    return f"{own_command()} watch {step_id[:2]}"


def replay_command(case: str) -> str:
    """Asks a case again; its file lies beside the report."""
    return kit_command("replay", case)


def inspect_options(args: Sequence[str]) -> list[str]:
    """Those with which `inspect` looks into a picture that was made with `args`."""
    pairs = zip(args[::2], args[1::2], strict=False)
    return [word for name, value in pairs if name in _OF_INSPECT for word in (name, value)]


def _inspect_words(case: ImageCase, x: int, y: int, has_reference: bool) -> list[str]:
    """After `./raysteps`: looks into a pixel of a picture, beside the reference's where the reader's kit has one."""
    options = inspect_options(case.args)
    return ["inspect", case.scene, str(x), str(y), *options, *(["--against", "reference"] if has_reference else [])]


def inspect_command(name: str, step: Step | None, *, has_reference: bool) -> str | None:
    """Looks into a pixel of the picture of that name, `{x}` and `{y}`; none where the kit does not know how it was
    made."""
    case = next((case for case in step.images if case.name == name), None) if step is not None else None
    if case is None or "{" in case.scene:
        return None
    start = quote_command([case.scene])
    line = kit_command(*_inspect_words(case, 0, 0, has_reference))
    return f"{line} ".replace(f" {start} 0 0 ", f" {start} {{x}} {{y}} ", 1).rstrip()


def inspect_worst(step: Step, image: ImageResult, out: Path) -> list[str] | None:
    """What to type after `./raysteps`, at the size of the picture itself: another size has other pixels."""
    case = next((case for case in step.images if case.name == image.name), None)
    if case is None or image.passed or not image.mine or not image.reference:
        return None
    from raysteps.images.compare import worst_pixel  # what takes longest to import, only where a picture is wrong

    worst = worst_pixel(out / image.mine, out / image.reference)
    return None if worst is None else _inspect_words(case, *worst, here().has_reference)


# Words that every view of a result shares, on pages and in the terminal.

HOW_SURE = {"mistake": "most likely", "transformation": "it looks as if", "finding": "look here"}  # of a diagnosis


def percent(share: float) -> str:
    """100 % only where nothing is missing."""
    return f"{min(share * 100, 100 if share >= 1 else 99.9):.3g} %"


def ended(outcome: Termination) -> str:
    """What became of a program that did not come to its end."""
    return in_words(outcome) if outcome in ("crashed", "timeout") else ""


class SaidOnce:
    """Of a sentence that many checks of a step have in common, how its program crashed or hung: nothing after the first
    time. What else is wrong is said of each."""

    def __init__(self, said: Sequence[str] = ()) -> None:
        self._said = set(said)

    def __call__(self, text: str, outcome: Termination) -> str:
        if not ended(outcome):
            return text
        is_new = text not in self._said
        self._said.add(text)
        return text if is_new else ""


def hand_in_words(results: Results) -> list[str]:
    """Of what course it is, when it came, and what lateness leaves of the points: in words that show the sum."""
    found = results.handed_in
    lines = [f"{results.course}."] if results.course else []
    if found is None:
        return lines
    if found.late is not None and found.late.days:
        lines.append(f"Late: {number(found.late.points)} of {number(results.total.points)} points count.")
    if found.late is not None:
        lines.append(found.late.words)
    elif found.submitted_at:
        lines.append(f"Handed in {moment(found)}.")
    return lines


def override_words(found: PointsOverride, *, whole: bool = False) -> str:
    """What a person changed, as the student reads it."""
    if whole:
        return f"{found.points:+g} points for the submission as a whole, from your instructor: {found.reason}"
    what = f"the points for {_PART_WORDS[found.part]}" if found.part else "the points"
    change = f"from {number(found.automatic)} to {number(found.points)}"
    return f"Your instructor changed {what} {change}: {found.reason}"


_PART_WORDS = {"tests": "tests", "pictures": "pictures", "hidden": "the hidden part", "together": "working together"}
_SINCE_THEN = {
    "": "",
    "moved": "The code has changed since this was written.",
    "gone": "The code has changed since this was written, and the line is not there any more.",
}


def since_words(found: Comment) -> str:
    """What became of the commented code; empty where it is as it was."""
    if found.since_then == "moved" and found.line and found.line != found.line_then:
        return f"{_SINCE_THEN['moved']} It was line {found.line_then} then."
    return _SINCE_THEN[found.since_then]


def review_lines(review: Review | None, *, whole: bool = False, code: bool = True) -> list[str]:
    """All that people added to a step, or to a whole submission, a line each; `code`: with the lines they are about."""
    if review is None:
        return []
    lines = [f"{override_words(found, whole=whole)} ({found.author})" for found in review.overrides]
    for found in review.comments:
        where = f"Line {found.line}: " if found.line else ""
        what = f"`{found.excerpt[found.line - found.first].strip()}`: " if code and _has_line(found) else ""
        lines.append(" ".join(filter(None, [f"{where}{what}{found.text} ({found.author})", since_words(found)])))
    for asked in review.requests:
        said = (
            f"Answer ({asked.answered_by}): {asked.answer}" if asked.state == "answered" else "It is not answered yet."
        )
        lines.append(f"You asked: {asked.text} {said}")
    return lines


def _has_line(found: Comment) -> bool:
    return bool(found.line) and 0 <= found.line - found.first < len(found.excerpt)


def moment(found: HandIn) -> str:
    """`2026-11-21 18:04:00+01:00`, and what says so where it is not sure."""
    return found.submitted_at.replace("T", " ") + (", by the time of the file" if found.by_file else "")


def total_words(total: Total, *, visible_only: bool = False) -> str:
    """`80.5 of 100 points, and 5 of 20 bonus points`; of a bonus alone `6 of 10 bonus points`."""
    of_what = " of the visible part" if visible_only else ""
    extra = f"{tenths(total.bonus.points)} of {tenths(total.bonus.max)} bonus points"
    if not total.max:
        return f"{extra}{of_what}"
    bonus = f", and {extra}" if total.bonus.points else ""
    return f"{tenths(total.points - total.bonus.points)} of {tenths(total.max)} points{of_what}{bonus}"


# Places in a student's own files, for a terminal: an editor opens a place that it finds from the folder of the kit.


def with_folder(text: str, step: Step) -> str:
    """`own.cpp:14:49` of the step, or of its tests, as `steps/01-own/own.cpp:14:49`; shown code stays as it is."""
    stem = re.escape(Path(step.file).stem)
    place = re.compile(rf"(?<![\w./\\-])({stem}(?:_test)?\.cpp)(?=[:(]\d)")
    lines = text.split("\n")
    return "\n".join(
        line if re.match(r" *\d* *\|", line) else place.sub(rf"steps/{step.id}/\1", line) for line in lines
    )


def tests_with_folder(tests: Sequence[TestResult], step: Step) -> list[TestResult]:
    return [
        replace(test, message=with_folder(test.message, step), location=with_folder(test.location, step))
        for test in tests
    ]


def result_with_folder(result: StepResult, step: Step) -> StepResult:
    """A copy of which all places are told like that."""
    told = replace(result, build_log=with_folder(result.build_log, step))
    told.messages = [with_folder(message, step) for message in result.messages]
    told.tests = tests_with_folder(result.tests, step)
    told.images = [replace(image, message=with_folder(image.message, step)) for image in result.images]
    told.hidden = [replace(item, message=with_folder(item.message, step)) for item in result.hidden]
    told.cumulative = replace(told.cumulative, message=with_folder(told.cumulative.message, step))
    told.diagnoses = [
        replace(one, title=with_folder(one.title, step), hint=with_folder(one.hint, step)) for one in result.diagnoses
    ]
    return told


# What the compiler warns of.

_MAX_WARNINGS = 3
_WARNING = re.compile(
    r"^(?P<text>(?:[A-Za-z]:(?=[\\/]))?[^\s:(][^\n:(]{0,200}(?::\d{1,7}(?::\d{1,7})?|\(\d{1,7}(?:,\d{1,7})?\)): "
    r"warning(?: C\d{1,6})?: .{1,300}?)(?: \[-W[\w=+-]{1,60}\]|$|(?<=.{300}))",
    re.M,
)
_WHOLE_NUMBERS = re.compile(r"conversion [^\n]{0,40}'(?:const )?int' to '(?:const )?float'")
_DIVIDED = "Of whole numbers 1 / 2 is 0: where they are divided, write float(a) / float(b)."


def _importance(warning: str) -> int:
    """A variable without a value is a mistake; a conversion mostly is none."""
    if "uninitialized" in warning:
        return 0
    return 2 if _WHOLE_NUMBERS.search(warning) else 1


def warnings_of(result: StepResult) -> list[list[str]]:
    """Of a step that is wrong, for whoever wrote it: the few that matter most, and under the first of its kind what to
    do where that is known."""
    if result.status in ("passed", "does-not-build"):
        return []
    all_of_them = dict.fromkeys(one["text"] for one in _WARNING.finditer(result.build_log))
    found = sorted(all_of_them, key=_importance)[:_MAX_WARNINGS]
    advised = next((text for text in found if _WHOLE_NUMBERS.search(text)), None)
    return [[text.replace(": warning: ", ": ", 1), *([_DIVIDED] if text == advised else [])] for text in found]
