"""A claim that few objects were tested counts only when the judge saw how the rays were spared.

How many were tested is counted in the program itself. The judge looks at the tree that the program hands out, and
counts by surfaces of its own. Who spares the rays nothing in the judge's cases may still spare them much in a picture,
of other shapes or of more of them; so each picture is believed or not by itself, by what the search costs in its scene.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from raysteps.common.text import listed
from raysteps.judge.functions import Function
from raysteps.judge.generators import functions_of
from raysteps.kit.manifest import Step
from raysteps.results.model import HiddenResult, ImageResult

MESSAGE = "The program says that this passes, but the judge's own inputs say otherwise; it does not count."
_MOST = 0.5

# The least share of the objects that the program can have tested in each picture, visible or hidden, by its name.
LeastShares: TypeAlias = Callable[[], Mapping[str, float]]


def _saves_nothing(result: HiddenResult, function: Function) -> bool:
    """No case of a kind is right, and most are not because they spare no work: another mistake is no such claim."""
    groups = [group for group in result.groups if function.by_name[group.name].saves]
    return any(not group.right and group.wasteful > _MOST * group.decided for group in groups)


def _line(name: str, share: float, least: float, wasteful: Sequence[str]) -> str:
    return (
        f"The picture '{name}' claims that {share:.1%} of the objects were tested, but the judge found that "
        f"{listed(wasteful)} spares the rays nothing: at least {least:.1%} must have been."
    )


def false_shares(
    step: Step, images: Sequence[ImageResult], hidden: Sequence[HiddenResult], least: LeastShares
) -> list[str]:
    """Takes back what nobody saw, and says so, one line for each picture."""
    known = functions_of(step.number)
    wasteful = [item.name for item in hidden if item.kind == "function" and _saves_nothing(item, known[item.name])]
    if not wasteful:
        return []
    bounds = least()
    lines = []
    for image in images:
        claimed, bound = image.share_tested or 0.0, bounds.get(image.name, 0.0)
        if image.passed and claimed < bound:
            lines.append(_line(image.name, claimed, bound, wasteful))
            image.passed, image.outcome, image.message = False, "wrong", MESSAGE
    for item in hidden:
        claimed, bound = item.share_tested or 0.0, bounds.get(item.name, 0.0)
        if item.kind == "picture" and item.share > 0 and claimed < bound:
            lines.append(_line(item.name, claimed, bound, wasteful))
            item.share, item.outcome, item.message = 0.0, "wrong", MESSAGE
    return lines
