"""Puts what people said and changed into a result: comments beside the code, points that count, answers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from raysteps.classroom.annotations import Annotation, Thread, annotations_of, code_mark, threads
from raysteps.classroom.database import ClassDatabase, Source
from raysteps.common.text import clean, number
from raysteps.course.manifest import Step
from raysteps.report.student import parts_of
from raysteps.results.class_model import HumanReview
from raysteps.results.model import (
    SAME_POINTS,
    Comment,
    PointsOverride,
    RegradeRequest,
    Results,
    Review,
    SinceThen,
    StepResult,
    Total,
)

_AROUND = 2  # lines before and after a commented one
_LINE = 300  # characters of it


class Blobs(Protocol):
    """Where older code is found."""

    def blob(self, digest: str) -> bytes | None: ...


# Where a commented line is now.


@dataclass(frozen=True)
class LinePlace:
    """A line and the file that it is in."""

    line: int
    lines: Sequence[str]
    since_then: SinceThen


def _likeness(old: Sequence[str], at: int, new: Sequence[str], other: int) -> int:
    """How many of the lines around that hold words are the same."""
    around = [offset for offset in range(-_AROUND, _AROUND + 1) if offset]
    pairs = [(at + offset, other + offset) for offset in around]
    there = [(old[a].strip(), new[b].strip()) for a, b in pairs if 0 <= a < len(old) and 0 <= b < len(new)]
    return sum(before == now and any(map(str.isalnum, now)) for before, now in there)


def line_now(one: Annotation, old: Sequence[str], source: Source | None) -> LinePlace:
    """The same line in the code as it is now, the one whose neighbours are most like those of before; without one
    neighbour it is another line that happens to read the same."""
    at = one.line - 1
    if source is not None and source.sha256 == one.source:
        return LinePlace(one.line, source.lines, "")
    new = source.lines if source is not None else []
    wanted = one.line_text.strip()
    found = [index for index, text in enumerate(new) if text.strip() == wanted]
    found.sort(key=lambda index: (-_likeness(old, at, new, index), abs(index - at)))
    if found and _likeness(old, at, new, found[0]):
        return LinePlace(found[0] + 1, new, "moved")
    return LinePlace(one.line, old or ["" for _ in range(at)] + [one.line_text], "gone")


def _comment(thread: Thread, sources: Mapping[str, Source], blobs: Blobs) -> Comment:
    last = thread.last
    if not last.line:
        source = sources.get(last.step)
        other = bool(last.source) and (source is None or source.sha256 != last.source)
        return Comment(last.author, last.at, last.text, since_then="moved" if other else "")
    old = (blobs.blob(last.source) or b"").decode("utf-8", "replace")
    place = line_now(last, old.split("\n") if old else [], sources.get(last.step))
    first = max(1, place.line - _AROUND)
    excerpt = [clean(text, _LINE) for text in place.lines[first - 1 : place.line + _AROUND]]
    return Comment(last.author, last.at, last.text, place.line, first, excerpt, place.since_then, last.line)


# Points.


def _override(one: Annotation, automatic: float) -> PointsOverride:
    """Who was given more than the grader gave has at least that, and who was given less has at most that: nobody is
    hurt by what was meant as a favour when better work comes."""
    points = one.points
    if one.step:
        points = max(points, automatic) if points >= one.automatic else min(points, automatic)
    return PointsOverride(one.part, automatic, points, one.text, one.author, one.at)


def item_words(step: str, part: str) -> str:
    """`02 hidden`, `02`, `the submission as a whole`."""
    return f"{step[:2]} {part}".strip() if step else "the submission as a whole"


def change_words(step: str, found: PointsOverride) -> str:
    """As results.csv and class.html tell it."""
    what = item_words(step, found.part)
    if not step:
        return f"{found.points:+g} for {what} by {found.author}: {found.reason}"
    return f"{what} from {number(found.automatic)} to {number(found.points)} by {found.author}: {found.reason}"


def _earned(result: StepResult, step: Step | None, part: str) -> float:
    """What the grader gives for a part, or for all of the step."""
    parts = {found.name: found.earned for found in parts_of(result, step)}
    return parts.get(part, 0.0) if part else result.points


def _reviewed_step(
    result: StepResult, step: Step | None, mine: Sequence[Thread], sources: Mapping[str, Source], blobs: Blobs
) -> StepResult:
    points = result.points
    changed = [_override(one, _earned(result, step, one.part)) for one in _points(mine)]
    whole = [found for found in changed if not found.part]
    if whole:  # goes before what was said of its parts
        changed, points = whole, whole[0].points
    elif changed:
        points = max(0.0, round(points + sum(found.points - found.automatic for found in changed), 2))
    changed = [found for found in changed if found.points != found.automatic]
    return replace(result, points=points, review=_review(result.points, changed, mine, sources, blobs))


def _points(mine: Sequence[Thread]) -> list[Annotation]:
    return [thread.last for thread in mine if thread.last.kind == "points" and not thread.last.withdrawn]


def _standing(mine: Sequence[Thread], kind: str) -> list[Thread]:
    return [thread for thread in mine if thread.last.kind == kind and not thread.last.withdrawn]


def _request(thread: Thread) -> RegradeRequest:
    first, last = thread.first, thread.last
    if not last.answer:
        return RegradeRequest(last.text, first.author, first.at, "open")
    return RegradeRequest(last.text, first.author, first.at, "answered", last.answer, last.author, last.at)


def _review(
    automatic: float,
    changed: list[PointsOverride],
    mine: Sequence[Thread],
    sources: Mapping[str, Source],
    blobs: Blobs,
) -> Review | None:
    comments = sorted(
        (_comment(thread, sources, blobs) for thread in _standing(mine, "comment")), key=lambda one: one.line
    )
    requests = [_request(thread) for thread in _standing(mine, "request")]
    if not changed and not comments and not requests:
        return None
    return Review(automatic, changed, comments, requests)


def _look_again(mine: Sequence[Annotation], results: Results, known: Mapping[str, Step]) -> list[str]:
    """Changed points where the grader gives others than it gave then. `results` are the grader's."""
    found = []
    steps = {step.id: step for step in results.steps}
    for one in mine:
        if not one.step:
            continue
        what = item_words(one.step, one.part)
        if one.step not in steps:
            found.append(f"{what}: the step is not graded any more, and the {number(one.points)} points do not count")
            continue
        now = _earned(steps[one.step], known.get(one.step), one.part)
        if abs(now - one.automatic) > SAME_POINTS:
            counts = _override(one, now).points == now
            found.append(
                f"{what}: {one.author} made {number(one.points)} of the {number(one.automatic)} that the grader gave "
                f"then; now it gives {number(now)}{', which counts' if counts else ''}"
            )
    return found


# A whole submission.


@dataclass(frozen=True)
class ReviewedResults:
    """`results` hold the points that count; lateness comes after that."""

    results: Results
    review: HumanReview


def review_results(
    results: Results,
    steps: Sequence[Step],
    annotations: Sequence[Annotation],
    sources: Mapping[str, Source],
    mark: str,
    blobs: Blobs,
) -> ReviewedResults:
    """`mark` is that of the code as it is now."""
    found = threads(annotations)
    known = {step.id: step for step in steps}
    graded = {result.id for result in results.steps}

    def about(step: str) -> list[Thread]:
        return [thread for thread in found if thread.last.step == step]

    made = [_reviewed_step(step, known.get(step.id), about(step.id), sources, blobs) for step in results.steps]
    whole = [_override(one, results.total.points) for one in _points(about(""))]
    strays = [thread for thread in found if thread.last.step not in graded and thread.last.kind != "points"]
    review = _review(results.total.points, whole, strays, sources, blobs)
    changed = replace(
        results, steps=made, total=Total.of(made, sum(one.points for one in whole)), review=review
    ) if found else results  # fmt: skip
    words = [change_words(step.id, one) for step in made if step.review for one in step.review.overrides]
    words += [change_words("", one) for one in whole]
    again = _look_again(_points(found), results, known)
    return ReviewedResults(changed, _human_review(found, mark, results.total.points, words, again))


def _human_review(
    found: Sequence[Thread], mark: str, automatic: float | None, changes: list[str], look_again: list[str]
) -> HumanReview:
    requests = [_request(thread) for thread in _standing(found, "request")]
    return HumanReview(
        automatic=automatic,
        changes=changes,
        look_again=look_again,
        comments=len(_standing(found, "comment")),
        requests=len(requests),
        open_requests=sum(one.state == "open" for one in requests),
        read=any(thread.last.source == mark for thread in _standing(found, "read")),
    )


def reviewed(
    database: ClassDatabase, submission: int, run: int, results: Results, steps: Sequence[Step]
) -> ReviewedResults:
    """The result with all that people added to it until now."""
    sources = database.sources(submission, run)
    annotations = annotations_of(database, submission)
    return review_results(results, steps, annotations, sources, code_mark(database, sources, run), database)


def review_of_nothing(database: ClassDatabase, submission: int, run: int | None) -> HumanReview:
    """Of a submission without results: what was said stays, and points wait until there are some."""
    found = threads(annotations_of(database, submission))
    mark = code_mark(database, database.sources(submission, run) if run is not None else {}, run)
    waiting = [
        f"{item_words(one.step, one.part)}: was changed, but there is no result that it could count in"
        for one in _points(found)
    ]
    return _human_review(found, mark, None, [], waiting)
