"""report.html: the results of one submission as a page."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from pathlib import Path
from typing import Any

from raysteps.common.errors import reason_or_fault
from raysteps.common.files import write_if_changed
from raysteps.common.text import apportion, clean, count, mean, number, size, tenths
from raysteps.course.manifest import Step
from raysteps.images.compare import GROSS, read_png
from raysteps.report.attempts import History, OwnProgress, chart_of, history_of
from raysteps.report.page import (
    COMPARE_SCRIPTS,
    COMPARE_STYLES,
    NotAPicture,
    PictureData,
    flip_map,
    picture_data,
    pixel_data,
    render_page,
)
from raysteps.report.wording import (
    HOW_SURE,
    SaidOnce,
    after_the_last,
    check_command,
    ended,
    inspect_command,
    moment,
    override_words,
    percent,
    replay_command,
    since_words,
    total_words,
    watch_command,
)
from raysteps.results.model import (
    Comment,
    Diagnosis,
    HiddenResult,
    Histogram,
    ImageResult,
    Results,
    Review,
    StepResult,
    TestResult,
    Total,
)
from raysteps.results.store import REPORT, RESULTS, read_results

# The pictures of a submission, as far as there is room for them in one page.

_MAX_PIXELS = 1 << 22

ImageKey = tuple[str, str]  # step and name of the picture


@dataclass
class ShownImage:
    """What there is to be compared, and the same larger."""

    pictures: dict[str, PictureData | None] = field(default_factory=dict)
    large: PictureData | None = None
    left_out: bool = False

    @property
    def any(self) -> bool:
        return any(self.pictures.values())


def _path(folder: Path, name: str | None) -> Path | None:
    """Nothing outside of the folder is shown, whatever a document says."""
    if not name:
        return None
    path = (folder / name).resolve()
    return path if path.is_relative_to(folder.resolve()) else None


def _read(path: Path | None) -> PictureData | None:
    try:
        return picture_data(path) if path is not None else None
    except NotAPicture:
        return None


def _flip(folder: Path, image: ImageResult, sides: Mapping[str, PictureData | None]) -> PictureData | None:
    """Only where there is something to see: for equal pictures it would be black."""
    reference, mine = sides["reference"], sides["mine"]
    if reference is None or mine is None or reference.src == mine.src:
        return None
    if reference.width * reference.height > _MAX_PIXELS or mine.width * mine.height > _MAX_PIXELS:
        return None
    pixels = []
    for name in (image.reference, image.mine):
        path = _path(folder, name)
        assert path is not None
        try:
            pixels.append(read_png(path))
        except (OSError, ValueError):
            return None
    gray = flip_map(pixels[0], pixels[1])
    return pixel_data(gray) if gray is not None else None


def _wrong_first(results: Results) -> Iterator[tuple[ImageKey, ImageResult]]:
    images = [((step.id, image.name), image) for step in results.steps for image in step.images]
    return iter(sorted(images, key=lambda item: bool(item[1].passed)))


def make_album(results: Results, folder: Path, room: int) -> dict[ImageKey, ShownImage]:
    """As many as fit into so many characters: the wrong ones first, then the right ones, then larger ones, and maps
    last."""
    album: dict[ImageKey, ShownImage] = {}
    for place, image in _wrong_first(results):
        sides = {"reference": _read(_path(folder, image.reference)), "mine": _read(_path(folder, image.mine))}
        size = sum(len(side.src) for side in sides.values() if side is not None)
        album[place] = ShownImage(sides) if size <= room else ShownImage(left_out=True)
        room -= size if size <= room else 0
    for place, image in _wrong_first(results):
        large = _read(_path(folder, image.large))
        if large is not None and len(large.src) <= room:
            album[place].large = large
            room -= len(large.src)
    for place, image in _wrong_first(results):
        shown = album[place]
        flip = _flip(folder, image, shown.pictures) if shown.any else None
        if flip is not None and len(flip.src) <= room:
            shown.pictures["flip"] = flip
            room -= len(flip.src)
    return album


# How the points of a step come about.

_NEAR = 0.11  # points: a step's are whole tenths, and with a mistake at least one less than all


@dataclass(frozen=True)
class ScorePart:
    """One of the four things that earn points."""

    name: str
    said: str  # how much of it was right
    share: float
    percent: float  # of the step's points that it is worth
    most: float
    earned: float


def _right(items: Sequence[TestResult | ImageResult], noun: str, share: float) -> tuple[str, float]:
    right = sum(item.passed for item in items)
    return (f"{percent(share)}: {right} of {count(len(items), noun)} right" if items else "not run", share)


def _together(result: StepResult) -> str:
    """Of the picture of all steps together, which is drawn where those of the step are."""
    return "right" if result.cumulative.passed else "wrong" if result.images else "not run"


def parts_of(result: StepResult, step: Step | None) -> list[ScorePart]:
    """Tests, pictures, hidden and together; without the hidden part where the kit cannot judge it. Nothing when the
    step's weights are not known."""
    if step is None:
        return []
    share = result.share_of_hidden
    found = [
        ("tests", _right(result.tests, "test", result.share_of_tests), step.weight_tests),
        ("pictures", _right(result.images, "picture", result.share_of_images), step.weight_images),
        ("hidden", (percent(share) if result.hidden else "not run", share), step.weight_hidden),
        ("together", (_together(result), float(result.cumulative.passed)), step.weight_together),
    ]
    if result.max < step.points - _NEAR:
        found = [part for part in found if part[0] != "hidden"]
    found = [part for part in found if part[2] > 0]
    exact = [step.points * weight * share for _, (_, share), weight in found]
    explained = result.points if abs(result.points - sum(exact)) <= _NEAR else sum(exact)
    most = _in_tenths(result.max, [weight for _, _, weight in found])
    return [
        ScorePart(name, said, share, weight * 100, whole, earned)
        for (name, (said, share), weight), whole, earned in zip(found, most, _in_tenths(explained, exact), strict=True)
    ]


def _in_tenths(total: float, weights: Sequence[float]) -> list[float]:
    """Shares of the total, rounded so that what is shown adds up."""
    return [part / 10 for part in apportion(round(total * 10), weights)]


def rest_of(result: StepResult, parts: Sequence[ScorePart]) -> float:
    """Points that the parts do not account for, as when an older kit weighed them otherwise."""
    rest = result.points - sum(part.earned for part in parts)
    return round(float(rest), 1) if parts and abs(rest) > _NEAR else 0.0


# What people added to a step or to a whole submission.


def parts_that_count(result: StepResult, step: Step | None) -> list[ScorePart]:
    """As `parts_of`, with what a person changed in them."""
    review = result.review
    if review is None:
        return parts_of(result, step)
    changed: dict[str, float] = {found.part: found.points for found in review.overrides}
    automatic = parts_of(replace(result, points=review.automatic), step)
    return [replace(part, earned=changed.get(part.name, part.earned)) for part in automatic]


def _comment_view(found: Comment) -> dict[str, object]:
    lines = [
        {"number": found.first + at, "text": clean(text, _TEXT), "meant": found.first + at == found.line}
        for at, text in enumerate(found.excerpt)
    ]
    return {
        "text": clean(found.text),
        "author": clean(found.author, 200),
        "line": found.line,
        "lines": lines,
        "since": since_words(found),
    }


def review_view(review: Review | None, *, whole: bool = False) -> dict[str, Any] | None:
    """None where nobody said or changed anything."""
    if review is None:
        return None
    return {
        "overrides": [(clean(override_words(one, whole=whole)), clean(one.author, 200)) for one in review.overrides],
        "comments": [_comment_view(one) for one in review.comments],
        "requests": [
            {
                "text": clean(one.text),
                "answer": clean(one.answer) if one.state == "answered" else "",
                "by": clean(one.answered_by, 200),
            }
            for one in review.requests
        ],
    }


# One step of the results, made ready for a page. Whatever a student's program may have said is cleaned.

_LOG = 20_000  # characters of what the compiler said
_TEXT = 2_000  # of any other text
_HINTS = ("a question", "an idea", "pseudocode")


def diagnosis_view(diagnosis: Diagnosis) -> dict[str, object]:
    """The word before it says how sure one can be."""
    finding = diagnosis.kind == "finding"
    lines = (("You see", diagnosis.sees), ("Cause", diagnosis.cause), ("Hint", diagnosis.hint))
    return {
        "sure": HOW_SURE[diagnosis.kind].capitalize() + ("" if diagnosis.kind == "transformation" else ":"),
        "title": clean(diagnosis.title),
        "alike": [clean(other) for other in diagnosis.alike],
        "seen_in": "" if finding else ", ".join(clean(name) for name in diagnosis.seen_in),
        "lines": [(label, clean(text)) for label, text in lines if text],
    }


_CODE = re.compile(r" +\d* +\| ")  # as compile_message begins lines of a source


def _blocks(message: str) -> list[tuple[bool, str]]:
    """Its sentences, and its lines of code, which keep their columns."""
    lines = groupby(message.splitlines(), lambda line: _CODE.match(line) is not None)
    return [(is_code, "\n".join(block)) for is_code, block in lines]


def _test(test: TestResult, once: SaidOnce) -> dict[str, object]:
    words = ("name", "expression", "expanded", "location")
    texts = {word: clean(getattr(test, word), _TEXT) for word in words}
    return {
        **texts,
        "message": once(clean(test.message, _TEXT), test.outcome),
        "passed": test.passed,
        "ended": ended(test.outcome),
        "waits_for": clean(test.waits_for),
    }


_MAX_BARS = 64  # of a file that may be anybody's
_WIDE, _TALL = 320, 96  # a drawing of how numbers are spread


def _spread(found: Histogram | None) -> dict[str, object] | None:
    """Bars for what came, and a line, with steps, for what should come."""
    if found is None or not 0 < len(found.counts) == len(found.expected) <= _MAX_BARS:
        return None
    top = max(1.0, *found.counts, *found.expected)
    width = _WIDE / len(found.counts)
    heights = [_TALL * count / top for count in found.counts]
    levels = [round(_TALL - _TALL * part / top, 2) for part in found.expected]
    parts = range(1, 1 + len(levels))
    return {
        "over": clean(found.over),
        "count": sum(found.counts),
        "width": _WIDE,
        "height": _TALL,
        "bars": [
            {"x": round(at * width + 1, 2), "y": round(_TALL - tall, 2), "width": width - 2, "height": round(tall, 2)}
            for at, tall in enumerate(heights)
        ],
        "line": f"M0 {levels[0]}"
        + "".join(f"V{level}H{width * at:g}" for at, level in zip(parts, levels, strict=True)),
        "words": "; ".join(
            f"{count} instead of {part:.0f}" for count, part in zip(found.counts, found.expected, strict=True)
        ),
    }


def _hidden(item: HiddenResult, once: SaidOnce, has_reference: bool) -> dict[str, object]:
    groups = [replace(group, name=clean(group.name)) for group in item.groups]
    return {
        "name": clean(item.name),
        "passed": item.share >= 1,
        "waits_for": clean(item.waits_for),
        "percent": percent(item.share),
        "message": once(clean(item.message), item.outcome),
        "spread": _spread(item.histogram),
        "case": [
            (label, clean(text, _TEXT))
            for label, text in (("Given", item.given), ("Expected", item.expected), ("Got", item.actual))
            if text
        ],
        "again": replay_command(clean(item.case)) if item.case and has_reference else "",
        "groups": [group for group in groups if group.right < group.cases],
    }


def _tests_per_ray(image: ImageResult) -> tuple[str, str] | None:
    """Of surfaces and boxes together: yours and the reference's."""
    if image.work is None or image.reference_work is None:
        return None
    return mean(image.work.tests_per_ray), mean(image.reference_work.tests_per_ray)


def _work(image: ImageResult) -> list[tuple[str, str, str]]:
    """What the picture cost: what was counted, mine and the reference's."""
    mine, reference = image.work, image.reference_work
    if mine is None or reference is None:
        return []
    return [
        ("surfaces tested per ray", mean(mine.surfaces_per_ray), mean(reference.surfaces_per_ray)),
        ("boxes tested per ray", mean(mine.boxes_per_ray), mean(reference.boxes_per_ray)),
        ("boxes", str(mine.boxes), str(reference.boxes)),
        ("entries in their lists", str(mine.references), str(reference.references)),
        ("memory", size(mine.bytes), size(reference.bytes)),
    ]


def _tier(image: ImageResult, step: Step) -> list[str]:
    """What the tree has reached, where that hangs on this picture."""
    from raysteps.results.work_ratio import image_tier  # few steps have tiers

    tier = image_tier(image, step)
    return [f"the tree: {tier.reached}. In tests per ray: {tier.to_reach}"] if tier is not None else []


def _image(
    image: ImageResult, at: str, step: Step | None, shown: ShownImage, once: SaidOnce, has_reference: bool
) -> dict[str, object]:
    wrong, share = image.wrong_share, image.share_tested
    facts = []
    if image.noisy and image.passed:
        facts.append("the light of its parts is no more off than chance explains")
    elif wrong is not None and not image.noisy:
        facts.append(f"{wrong:.2%} of the pixels are wrong; at most {image.max_wrong:.2%} may be")
    if share is not None and image.max_share is not None:
        facts.append(f"a ray tests {share:.3g} of the objects; at most {image.max_share:.3g} of them may be tested")
    if step is not None and step.is_about_a_tree:
        facts += _tier(image, step)
    return {
        "at": at,
        "name": clean(image.name),
        "scene": clean(image.scene),
        "passed": image.passed,
        "waits": bool(image.waits_for),
        "message": once(clean(image.message), image.outcome),
        "facts": facts,
        "noisy": image.noisy,  # then what is wrong is counted in parts, and else the page sees each pixel itself
        "wrong_share": wrong if wrong is not None and wrong > GROSS and not image.noisy else None,
        "shown": shown,
        "files": [clean(name) for name in (image.mine, image.reference) if name],
        "inspect": inspect_command(image.name, step, has_reference=has_reference),
        "work": _work(image),
        "tests_per_ray": _tests_per_ray(image),
    }


def hint_views(hints: Sequence[str]) -> list[dict[str, str]]:
    """Level by level. What is set in columns keeps them; other lines are one paragraph."""
    kinds = _HINTS if len(hints) == len(_HINTS) else [""] * len(hints)
    return [
        {"kind": kind, "text": text.strip("\n"), "form": "code" if re.search(r"\S {2,}\S", text) else "prose"}
        for kind, text in zip(kinds, hints, strict=True)
    ]


def step_view(
    result: StepResult, step: Step | None, album: Mapping[ImageKey, ShownImage], has_reference: bool
) -> dict[str, object]:
    """All that the page says of a step; `has_reference`: its reader has the whole kit, and every command."""
    status = result.shown
    parts = parts_that_count(result, step)
    messages = [clean(message) for message in result.messages]
    once = SaidOnce(messages)
    tests = [_test(test, once) for test in result.tests]
    images = [
        _image(image, f"picture-{result.id[:2]}-{at}", step, album[(result.id, image.name)], once, has_reference)
        for at, image in enumerate(result.images)
    ]
    return {
        "id": result.id,
        "number": result.id[:2],
        "title": step.title if step is not None else result.id[3:].replace("-", " "),
        "status": {"id": result.status, "words": status.words, "tone": status.tone, "sign": status.sign},
        "points": tenths(result.points),
        "max": tenths(result.max),
        "share": result.points / result.max if result.max else 0.0,
        "worth": tenths(step.points) if step is not None else "",
        "bonus": result.bonus,
        "parts": parts,
        "rest": rest_of(result, parts),
        "messages": [_blocks(message) for message in messages],
        "diagnoses": [diagnosis_view(diagnosis) for diagnosis in result.diagnoses],
        "tests": tests,
        "hidden": [_hidden(item, once, has_reference) for item in result.hidden],
        "images": images,
        "build_log": clean(result.build_log, _LOG),
        "together": {"passed": result.cumulative.passed, "message": clean(result.cumulative.message)},
        "hints": hint_views(step.hints) if step is not None else [],
        "check": check_command(result.id),
        "review": review_view(result.review),
    }


_NO_PROGRESS = OwnProgress()
_MAX = 4_900_000  # bytes: a page that can be sent by mail
_ROOM = 4_300_000  # of them for pictures, unless there is more text than usual
_PARTS = ("tests", "pictures", "hidden", "together")


def next_step(steps: Sequence[StepResult]) -> StepResult | None:
    """The first step that is not solved; a bonus only when nothing else is left."""
    unsolved = [step for step in steps if step.status != "passed"]
    return next((step for step in unsolved if not step.bonus), unsolved[0] if unsolved else None)


@dataclass(frozen=True)
class OwnPicture:
    """One of the student's pictures, in the list above all steps."""

    at: str  # the id of its place in the step
    number: str
    title: str
    name: str
    passed: bool
    waits: bool
    message: str
    is_large: bool


def _own_pictures(
    results: Results, views: Mapping[str, Mapping[str, Any]], following: StepResult | None
) -> list[OwnPicture]:
    """Those of the next thing to do come first, then what else is wrong, then what waits; what is right goes back from
    the last step."""
    found = [
        (step, image)
        for step in reversed(results.steps)
        for image in views[step.id]["images"]
        if image["shown"].pictures.get("mine") is not None
    ]
    found.sort(key=lambda pair: (pair[1]["passed"], pair[1]["waits"], pair[0] is not following))
    return [
        OwnPicture(
            image["at"],
            step.id[:2],
            views[step.id]["title"],
            image["name"],
            image["passed"],
            image["waits"],
            image["message"],
            image["shown"].large is not None,
        )
        for step, image in found
    ]


def _walk(results: Results, own: Sequence[OwnPicture]) -> list[OwnPicture]:
    """Of each step, in their order, the first picture that is there larger, else the first."""
    first = {picture.number: picture for picture in reversed(own)}
    first |= {picture.number: picture for picture in reversed(own) if picture.is_large}
    return [first[step.id[:2]] for step in results.steps if step.id[:2] in first]


def _share(total: Total) -> float:
    """Of what there is without a bonus, where there is something."""
    earned, most = (total.points - total.bonus.points, total.max) if total.max else (total.points, total.bonus.max)
    return earned / most if most else 0.0


def _total(total: Total) -> dict[str, object]:
    bonus = total.bonus
    return {
        "words": total_words(total),
        "points": tenths(total.points),
        "exact": number(total.points),
        "regular": tenths(total.points - bonus.points if total.max else total.points),
        "max": tenths(total.max or bonus.max),
        "is_bonus": not total.max,
        "share": _share(total),
        "bonus": tenths(bonus.points),
        "has_bonus": bonus.points > 0,
        "bonus_max": tenths(bonus.max) if bonus.max and total.max else "",
    }


def _hand_in_view(results: Results) -> dict[str, object]:
    """Whose it is, and what lateness leaves; empty where no class was graded."""
    found = results.handed_in
    late = found.late if found is not None else None
    return {
        "course": clean(results.course, 200),
        "who": clean(", ".join(found.students), 200) if found is not None else "",
        "when": clean(moment(found), 100) if found is not None and found.submitted_at else "",
        "words": clean(late.words) if late is not None else "",
        "final": number(late.points) if late is not None and late.days else "",
    }


def _history(results: Results, views: Mapping[str, Mapping[str, Any]]) -> History | None:
    """What was handed in before; nothing where no class was graded, or nothing was."""
    if not results.earlier:
        return None
    return history_of(results, {step: f"{view['number']} {view['title']}" for step, view in views.items()})


def _sums(parts: Sequence[ScorePart]) -> dict[str, float]:
    return {name: round(sum(part.earned for part in parts if part.name == name), 1) for name in _PARTS}


def student_page(
    results: Results,
    folder: Path,
    steps: Sequence[Step],
    progress: OwnProgress = _NO_PROGRESS,
    most: int = _MAX,
) -> str:
    """The page of results whose pictures lie in the folder. It shows what the results hold, and no more. It has at most
    that many bytes, as far as leaving pictures out can do that."""
    room = _ROOM - (_MAX - most)
    text = _page(results, make_album(results, folder, room), steps, progress)
    excess = len(text.encode()) - most
    if excess > 0:
        text = _page(results, make_album(results, folder, room - excess), steps, progress)
    return text


def _page(
    results: Results,
    album: Mapping[ImageKey, ShownImage],
    steps: Sequence[Step],
    progress: OwnProgress,
) -> str:
    known = {step.id: step for step in steps}
    views = {
        result.id: step_view(result, known.get(result.id), album, progress.has_reference) for result in results.steps
    }
    parts = [part for result in results.steps for part in parts_that_count(result, known.get(result.id))]
    following, beyond = next_step(results.steps), progress.following
    name = clean(results.submission, 200)
    own = _own_pictures(results, views, following)
    is_perfect = following is None and beyond is None and bool(results.steps)
    context = {
        "name": name,
        "hand_in": _hand_in_view(results),
        "review": review_view(results.review, whole=True),
        "extra": sum(one.points for one in results.review.overrides) if results.review is not None else 0.0,
        "history": _history(results, views),
        "steps": list(views.values()),
        "next": views[following.id] if following is not None else None,
        "beyond": {"number": beyond.number, "title": beyond.title, "watch": watch_command(beyond.id)}
        if beyond
        else None,
        "own": own,
        "changed": progress.changed,
        "chart": chart_of(progress.attempts) if progress.attempts else None,
        "walk": _walk(results, own) if is_perfect else [],
        "is_perfect": is_perfect,
        "try_next": after_the_last(),
        "total": _total(results.total),
        "columns": [name for name in _PARTS if not parts or any(part.name == name for part in parts)],
        "sums": _sums(parts),
        "number": number,
        "tenths": tenths,
        "left_out": sum(shown.left_out for shown in album.values()),
        "facts": {
            "kit": clean(results.kit, 200),
            "version": clean(results.version, 200),
            "isolation": clean(results.isolation.name, 200),
        },
    }
    styles, scripts = (*COMPARE_STYLES, "parts", "student"), (*COMPARE_SCRIPTS, "student")
    return render_page("student", f"Raysteps: {name}", context, scripts, styles)


def write_student_page(
    results: Results,
    folder: Path,
    steps: Sequence[Step],
    progress: OwnProgress = _NO_PROGRESS,
) -> Path:
    """Writes FOLDER/report.html."""
    path = folder / REPORT
    write_if_changed(path, student_page(results, folder, steps, progress).encode())
    return path


def try_student_page(
    folder: Path,
    steps: Sequence[Step],
    say: Callable[[str], None],
    progress: OwnProgress = _NO_PROGRESS,
) -> Path | None:
    """Of the results.json that was just written there: the results stand, whatever goes wrong with the page."""
    try:
        return write_student_page(read_results(folder / RESULTS), folder, steps, progress)
    except Exception as error:  # a page is not worth a grade
        say(f"no {REPORT}: {reason_or_fault(error)}")
        return None
