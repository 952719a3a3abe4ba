"""Renders the pictures of a step with the student's code and compares them."""

from dataclasses import dataclass
from pathlib import Path

from raysteps.common.text import number, printable, shorten
from raysteps.grading.pictures import compare, difference, write_png
from raysteps.grading.rendering import ReferencePictures, Rendered, render
from raysteps.grading.results import Cumulative, Ending, ImageResult
from raysteps.kit.manifest import ImageCase, Step
from raysteps.kit.project import Project


@dataclass(frozen=True)
class Gallery:
    """What pictures are made and judged with."""

    project: Project
    references: ReferencePictures
    out: Path


def _trouble(rendered: Rendered, seconds: float) -> tuple[Ending, str]:
    """What kept a picture from being made: outcome and message."""
    outcome = rendered.outcome
    if outcome.timed_out:
        return "timeout", f"The picture was not ready after {number(seconds)} seconds."
    if outcome.signal_name is not None:
        return "crashed", f"The program crashed ({outcome.signal_name})."
    if outcome.code != 0:
        said = shorten(printable(outcome.stderr.strip().rpartition("\n")[2]), 200)
        return "crashed", f"The program gave up with exit code {outcome.code}" + (f": {said}" if said else ".")
    return "wrong", f"{rendered.problem.capitalize()}."


def _too_many_tests(share: float | None, most: float) -> str:
    """Why a right picture was made with too much work, or nothing."""
    if not share:
        return "The picture is right, but no test of an object was counted: ask a surface with surface->hit(ray)."
    if share <= most:
        return ""
    return (
        f"The picture is right, but each ray tested {share * 100:.3g} % of the objects; at most {most * 100:.3g} % are "
        "allowed: the boxes must spare the rays most of the tests."
    )


def judge(gallery: Gallery, program: Path, step: Step, case: ImageCase) -> ImageResult:
    """One picture, with copies of mine, reference and difference as PNG."""
    reference = gallery.references.get(case)
    rendered = render(gallery.project, program, case, step.seconds, step.memory_mb)
    result = ImageResult(case.name, case.scene, False, case.max_wrong, max_share=case.max_share)
    result.seconds = round(rendered.outcome.seconds, 2)
    folder = Path("pictures") / step.id
    result.reference = (folder / f"{case.name}-reference.png").as_posix()
    write_png(reference, gallery.out / result.reference)
    if rendered.pixels is None:
        result.outcome, result.message = _trouble(rendered, step.seconds)
        return result
    result.mine = (folder / f"{case.name}-mine.png").as_posix()
    write_png(rendered.pixels, gallery.out / result.mine)
    verdict = compare(rendered.pixels, reference, case.max_wrong)
    result.passed, result.wrong_share, result.message = verdict.passed, round(verdict.wrong_share, 6), verdict.message
    if case.max_share is not None:
        result.share_tested = None if rendered.share_tested is None else round(rendered.share_tested, 6)
        problem = _too_many_tests(rendered.share_tested, case.max_share)
        if result.passed and problem:
            result.passed, result.message = False, problem
    result.outcome = "ok" if result.passed else "wrong"
    if rendered.pixels.shape == reference.shape:
        result.difference = (folder / f"{case.name}-difference.png").as_posix()
        write_png(difference(rendered.pixels, reference), gallery.out / result.difference)
    return result


def judge_together(gallery: Gallery, program: Path, step: Step) -> Cumulative:
    """The step's pictures with all the student's steps up to this one."""
    for case in step.images:
        rendered = render(gallery.project, program, case, step.seconds, step.memory_mb)
        if rendered.pixels is None:
            return Cumulative(False, f"{case.name}: {_trouble(rendered, step.seconds)[1]}")
        verdict = compare(rendered.pixels, gallery.references.get(case), case.max_wrong)
        if not verdict.passed:
            return Cumulative(False, f"{case.name}: {verdict.message}")
    return Cumulative(True, "")
