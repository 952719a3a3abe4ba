"""The pixel of a wrong picture that is most wrong, and the command that looks into it."""

from pathlib import Path

from raysteps.course.manifest import Step
from raysteps.images.compare import gaps, read_png, widest
from raysteps.report.wording import inspect_words
from raysteps.results.model import ImageResult


def worst_pixel(mine: Path, reference: Path) -> tuple[int, int] | None:
    """The column and the row; none where the pictures cannot be compared or are the same."""
    try:
        one, other = read_png(mine), read_png(reference)
    except OSError:
        return None
    if one.shape != other.shape:
        return None
    gap = gaps(one, other)
    return widest(gap) if gap.any() else None


def inspect_worst(step: Step, image: ImageResult, out: Path) -> list[str] | None:
    """What to type after `./raysteps`, at the size of the picture itself: another size has other pixels."""
    case = next((case for case in step.images if case.name == image.name), None)
    if case is None or image.passed or not image.mine or not image.reference:
        return None
    worst = worst_pixel(out / image.mine, out / image.reference)
    return None if worst is None else inspect_words(case, *worst)
