"""A claim that few objects were tested counts only when the judge saw how the rays were spared.

How many were tested is counted in the program itself. The judge looks at the tree that the program hands out, and
counts by surfaces of its own.
"""

from collections.abc import Sequence

from raysteps.common.text import listed
from raysteps.judge.functions import Function
from raysteps.judge.generators import functions_of
from raysteps.judge.hidden_scenes import twin_name
from raysteps.judge.plan import Plan
from raysteps.kit.manifest import Step
from raysteps.results.model import HiddenResult, ImageResult

MESSAGE = "The program says that this passes, but the judge's own inputs say otherwise; it does not count."
_MOST = 0.5
_TOO_GOOD = 0.25  # of what is allowed: not even rays into the empty sky make it so little


def _saves_nothing(result: HiddenResult, function: Function) -> bool:
    """No case of a kind is right, and most are not because they spare no work: another mistake is no such claim."""
    groups = [group for group in result.groups if function.by_name[group.name].saves]
    return any(not group.right and group.wasteful > _MOST * group.decided for group in groups)


def _with_limit(step: Step, plan: Plan) -> tuple[set[str], set[str]]:
    """The visible pictures and the hidden ones in which few objects may be tested."""
    visible = {image.name for image in step.images if image.max_share is not None}
    made_up = {scene.name for scene in plan.random_scenes if scene.max_share is not None}
    return visible, made_up | {twin_name(name) for name in visible}


def _owns_up(image: ImageResult) -> bool:
    """Whether the program itself says that its rays tested too much."""
    most = image.max_share
    return most is not None and image.share_tested is not None and image.share_tested > most


def false_shares(step: Step, plan: Plan, images: Sequence[ImageResult], hidden: Sequence[HiddenResult]) -> list[str]:
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
                f"the judge found that {listed(wasteful)} spares the rays nothing."
            )
            image.passed, image.outcome, image.message = False, "wrong", MESSAGE
    for item in hidden:
        if item.kind == "picture" and item.share > 0 and item.name in limited_hidden and not honest:
            item.share, item.outcome, item.message = 0.0, "wrong", MESSAGE
    return lines
