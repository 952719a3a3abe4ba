"""Where the wrong pixels of a picture lie, in words."""

from collections.abc import Sequence

import numpy as np

from raysteps.common.text import listed
from raysteps.diagnosis.evidence import Mask, Picture
from raysteps.diagnosis.objects import ObjectMap

_MOST = 0.95  # of the wrong pixels count for all
_NEARLY_ALL = 0.9  # of the picture
_MOST_OBJECTS = 3
_EDGES = 0.9
_SMALL = 0.5  # of the picture: a part that is worth its numbers


def edges_of(objects: ObjectMap) -> Mask:
    """The pixels beside another object."""
    numbers = objects.numbers
    mask = np.zeros(numbers.shape, dtype=np.bool_)
    down, across = numbers[1:] != numbers[:-1], numbers[:, 1:] != numbers[:, :-1]
    mask[1:] |= down
    mask[:-1] |= down
    mask[:, 1:] |= across
    mask[:, :-1] |= across
    return mask


def _along_edges(wrong: Mask, objects: ObjectMap) -> str:
    edges = edges_of(objects)
    if edges.mean() < _SMALL and (wrong & edges).sum() >= _EDGES * wrong.sum():
        return "along the edges of things"
    return ""


def _on_objects(wrong: Mask, objects: ObjectMap, scene: str) -> str:
    """Those that hold nearly all of them; nothing where that is most of what one sees."""
    numbers, counts = np.unique(objects.numbers[wrong], return_counts=True)
    order = np.argsort(-counts)
    reached = np.cumsum(counts[order]) >= _MOST * counts.sum()
    chosen = sorted(int(number) for number in numbers[order][: int(np.argmax(reached)) + 1])
    seen = np.unique(objects.numbers)
    if len(chosen) > _MOST_OBJECTS or len(chosen) >= max(2, len(seen) - 1):
        return ""
    words = [_name(number, objects) for number in chosen]
    return f"on {listed(words)}" + (f" of {scene}" if any(chosen) else "")


def _name(number: int, objects: ObjectMap) -> str:
    if not 0 < number <= len(objects.objects):
        return "the background"
    found = objects.objects[number - 1]
    return f"the {found.kind} of line {found.line}"


def _in_part(wrong: Mask) -> str:
    rows, columns = np.nonzero(wrong)
    height, width = wrong.shape
    top, bottom = (int(value) for value in np.percentile(rows, [1, 99]))
    left, right = (int(value) for value in np.percentile(columns, [1, 99]))
    if (bottom - top + 1) * (right - left + 1) > _SMALL * wrong.size:
        return ""
    row, column = (top + bottom) / 2 / height, (left + right) / 2 / width
    vertical = "upper" if row < 1 / 3 else "lower" if row > 2 / 3 else ""
    horizontal = "left" if column < 1 / 3 else "right" if column > 2 / 3 else ""
    where = f"{vertical} {horizontal}".strip() or "middle"
    return f"in the {where} part, x {left} to {right}, y {top} to {bottom}"


def _too(picture: Picture) -> str:
    """Whether they are all brighter, or all darker; nothing where the background and directions are not light."""
    wrong = picture.wrong
    step = picture.case.args[picture.case.args.index("--step") + 1] if "--step" in picture.case.args else ""
    if step in ("1", "2"):
        return ""
    gap = picture.mine[wrong].astype(np.int16).sum(axis=1) - picture.reference[wrong].astype(np.int16).sum(axis=1)
    if (gap > 0).mean() >= _MOST:
        return "they are too bright"
    return "they are too dark" if (gap < 0).mean() >= _MOST else ""


def place_of(picture: Picture, objects: ObjectMap, terms: Sequence[str]) -> str:
    """A sentence. `terms`: what else the wrong pixels have in common, such as `where there is shadow`."""
    wrong = picture.wrong
    scene = picture.case.scene.rpartition("/")[2]
    if wrong.mean() >= _NEARLY_ALL:
        where = ["nearly everywhere"]
    else:
        edges = _along_edges(wrong, objects)
        where = [edges] if edges else [_on_objects(wrong, objects, scene), *terms]
        where.append(_in_part(wrong))
    said = ", ".join(filter(None, where)) or "in many places"
    too = _too(picture)
    return f"In {picture.case.name} the wrong pixels lie {said}" + (f"; {too}." if too else ".")
